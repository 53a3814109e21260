# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Clean systems to try things in, as folders. To be sourced after workspace.sh; root is needed.

# Where the systems lie, some 3 GB each.
EC_CHROOTS=${EC_CHROOTS:-/var/tmp/external_command_chroots}
EC_DEBIAN_MIRROR=${EC_DEBIAN_MIRROR:-http://deb.debian.org/debian}
EC_UBUNTU_MIRROR=${EC_UBUNTU_MIRROR:-http://archive.ubuntu.com/ubuntu}

# ec_codename PLATFORM: the release of Debian's or Ubuntu's archive.
ec_codename() {
  case $1 in
    11) echo bullseye ;;
    12) echo bookworm ;;
    13) echo trixie ;;
    sid) echo sid ;;
    noetic-like) echo focal ;;
    *) ec_fail "there is no platform $1; known: 11 12 13 sid noetic-like" ;;
  esac
}

# ec_make_chroot CODENAME FOLDER [PACKAGE...]: a minimal system, by mmdebstrap or else by debootstrap.
ec_make_chroot() {
  local codename=$1 folder=$2 mirror=$EC_DEBIAN_MIRROR components=main packages trust=
  shift 2
  packages=$(IFS=, && echo "apt,$*")  # which Ubuntu does not count among the minimum
  if [ "$codename" = focal ]; then
    mirror=$EC_UBUNTU_MIRROR components=main,universe
    # Debian does not have the keys of Ubuntu's archive; what is made here is thrown away.
    [ -f /usr/share/keyrings/ubuntu-archive-keyring.gpg ] || trust=yes
  fi
  [ "$(id --user)" -eq 0 ] || ec_fail "a chroot takes root; run this as root"
  rm -rf --one-file-system "$folder"
  mkdir -p "$(dirname "$folder")"
  # A mirror that stands still is good for a test where this machine's apt takes it too.
  local check_date
  check_date="Acquire::Check-Valid-Until \"$(ec_apt_setting Acquire::Check-Valid-Until true)\";"
  if command -v mmdebstrap >/dev/null; then
    mmdebstrap --variant=minbase --aptopt="$check_date" --components="$components" "--include=${packages%,}" \
      "$codename" "$folder" "deb ${trust:+[trusted=yes] }$mirror $codename ${components/,/ }" >"$folder.log" 2>&1
  else
    debootstrap --variant=minbase ${trust:+--no-check-gpg} --components="$components" "--include=${packages%,}" \
      "$codename" "$folder" "$mirror" >"$folder.log" 2>&1
  fi || { tail -n 20 "$folder.log" >&2 && ec_fail "no $codename could be made from $mirror (see above)"; }
  echo "$check_date" >"$folder/etc/apt/apt.conf.d/90clean_system"
}

ec_apt_setting() {
  local value=
  eval "$(apt-config shell value "$1" 2>/dev/null)"
  echo "${value:-$2}"
}

# ec_in_chroot FOLDER [OUTSIDE=INSIDE...] -- COMMAND...: runs a command in a system of its own processes and mounts, which
# end with it. OUTSIDE is a folder of this machine that is seen, and can be written, as INSIDE.
ec_in_chroot() {
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -eu -c '
    folder=$1 && shift
    mount --make-rprivate /
    mount -t proc proc "$folder/proc"
    mount --rbind /dev "$folder/dev"
    while [ "$1" != -- ]; do
      mkdir -p "$folder/${1#*=}"
      mount --bind "${1%%=*}" "$folder/${1#*=}"
      shift
    done
    shift
    if [ -e /etc/resolv.conf ]; then cp --dereference /etc/resolv.conf "$folder/etc/resolv.conf"; fi
    exec chroot "$folder" env --ignore-environment HOME=/root TERM=dumb LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
      PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
  ' chroot "$@"
}

# ec_try_package CODENAME DEB: installs the .deb into a clean system, drives, removes it; the last line tells.
ec_try_package() {
  local folder=$EC_CHROOTS/clean-$1
  ec_make_chroot "$1" "$folder"
  mkdir -p "$folder/package"
  cp "$2" "$EC_ROOT"/scripts/lib/try_*.sh "$folder/package/"
  ec_in_chroot "$folder" -- /package/try_package.sh "/package/$(basename "$2")"
}
