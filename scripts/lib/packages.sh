# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# The system packages this package needs, and their installation. To be sourced; set -eu is expected.

# Names of Debian 11, 12, 13 and sid. `ros-*` hold the message definitions, `lib*-msgs-dev` their headers.
EC_DEBIAN_BUILD_PACKAGES=(
  g++ make cmake catkin ros-message-generation ros-message-runtime protobuf-compiler python3-setuptools
  libroscpp-dev libnodelet-dev libnodeletlib-dev pluginlib-dev libtf2-dev libtf2-msgs-dev libtf2-geometry-msgs-dev
  libactionlib-dev libdiagnostic-updater-dev
  libactionlib-msgs-dev libdiagnostic-msgs-dev libgeometry-msgs-dev libmove-base-msgs-dev libnav-msgs-dev
  libstd-msgs-dev libvisualization-msgs-dev
  ros-actionlib-msgs ros-diagnostic-msgs ros-geometry-msgs ros-move-base-msgs ros-nav-msgs ros-std-msgs
  ros-visualization-msgs
  libboost-dev libboost-serialization-dev libeigen3-dev libmetis-dev libompl-dev libprotobuf-dev libtinyxml2-dev
  libxxhash-dev
)
# Beside the libraries; the package of scripts/package depends on these.
EC_DEBIAN_RUN_PACKAGES=(
  libnodeletlib-tools rosbash
  python3-genpy python3-rosbag python3-rosgraph python3-roslaunch python3-roslib python3-rospy python3-rosservice
  python3-actionlib python3-actionlib-msgs python3-diagnostic-msgs python3-move-base-msgs
  python3-tf2-ros python3-geometry-msgs python3-nav-msgs python3-std-msgs python3-visualization-msgs
  python3-argcomplete python3-protobuf python3-yaml
  netbase  # makes /etc/hosts where there is none, as in a bare chroot: ROS needs the name localhost
)
EC_DEBIAN_TEST_PACKAGES=(
  catkin-lint libboost-program-options-dev libgtest-dev librostest-dev python3-rostest
  python3-numpy python3-rosnode python3-rosparam python3-rospkg python3-rostopic
  python3-rosunit
  rviz  # what demo.launch starts
  librviz-dev  # its panel is built where it is, and with it ec_qt_package
)

# Names of Ubuntu 20.04 with Noetic from packages.ros.org.
EC_NOETIC_BUILD_PACKAGES=(
  g++ make cmake protobuf-compiler python3-setuptools libboost-dev libboost-serialization-dev libeigen3-dev
  libmetis-dev libprotobuf-dev libtinyxml2-dev libxxhash-dev
  ros-noetic-actionlib ros-noetic-actionlib-msgs ros-noetic-catkin ros-noetic-diagnostic-msgs
  ros-noetic-diagnostic-updater ros-noetic-geometry-msgs ros-noetic-message-generation ros-noetic-move-base-msgs
  ros-noetic-nav-msgs ros-noetic-nodelet ros-noetic-ompl ros-noetic-pluginlib ros-noetic-roscpp ros-noetic-std-msgs ros-noetic-tf2
  ros-noetic-tf2-geometry-msgs ros-noetic-tf2-msgs ros-noetic-visualization-msgs
)
EC_NOETIC_RUN_PACKAGES=(
  python3-argcomplete python3-protobuf python3-yaml
  ros-noetic-genpy ros-noetic-message-runtime ros-noetic-rosbag ros-noetic-rosbash ros-noetic-rosgraph
  ros-noetic-roslaunch ros-noetic-roslib ros-noetic-rospy ros-noetic-rosservice ros-noetic-tf2-ros
)
EC_NOETIC_TEST_PACKAGES=(
  libboost-program-options-dev libgtest-dev python3-catkin-lint python3-numpy python3-rospkg
  ros-noetic-rosnode ros-noetic-rosparam ros-noetic-rostest ros-noetic-rostopic ros-noetic-rosunit
  ros-noetic-rviz
)

# Pictures of rviz, and tests of its panel: a display for where there is none, what draws, clicks, and takes pictures.
EC_SCREEN_PACKAGES=(xvfb x11-utils xdotool imagemagick libgl1-mesa-dri)

# What /etc/os-release says of NAME, e.g. ID or VERSION_CODENAME.
ec_os_release() { (set +u && . /etc/os-release 2>/dev/null && printf '%s' "${!1-}"); }

# On Ubuntu 20.04 ROS is Noetic of packages.ros.org; everywhere else, and there with EC_ROS=debian, it is what Debian and
# its kin have in their archive.
ec_is_noetic() { [ "$(ec_os_release VERSION_CODENAME)" = focal ] && [ "${EC_ROS-}" != debian ]; }

# The Qt that rviz was built with.
ec_qt_package() {
  case $(ec_os_release VERSION_CODENAME) in
    bullseye | bookworm | focal | jammy | noble) echo qtbase5-dev ;;
    *) echo qt6-base-dev ;;
  esac
}

# ec_install [PACKAGE...]: installs what is missing of the packages above, and of those named; a fraction of
# a second where all is there.
ec_install() {
  [ "${EC_NO_INSTALL:-0}" = 0 ] || return 0
  local wanted=("${EC_DEBIAN_BUILD_PACKAGES[@]}" "${EC_DEBIAN_RUN_PACKAGES[@]}" "${EC_DEBIAN_TEST_PACKAGES[@]}")
  if ec_is_noetic; then
    wanted=("${EC_NOETIC_BUILD_PACKAGES[@]}" "${EC_NOETIC_RUN_PACKAGES[@]}" "${EC_NOETIC_TEST_PACKAGES[@]}")
  fi
  wanted+=("${EC_SCREEN_PACKAGES[@]}" "$(ec_qt_package)" "$@")
  local found missing
  found=$(ec_missing_packages "${wanted[@]}") || exit 1
  [ -n "$found" ] || return 0
  mapfile -t missing <<<"$found"
  echo "${#missing[@]} of ${#wanted[@]} system packages are missing: ${missing[*]}"
  ec_apt_get "${missing[@]}"
}

# Prints those of the named packages that are not installed, one per line.
ec_missing_packages() {
  command -v dpkg-query >/dev/null ||
    ec_fail "this machine has no dpkg; install what matches the names below, then set EC_NO_INSTALL=1: $*"
  local installed
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
    sed -n 's/^installed //p') || true
  printf '%s\n' "$@" | grep --line-regexp --invert-match --fixed-strings --file <(printf '%s\n' "$installed") || true
}

# Installs the named packages as root, or by sudo; names what to type where neither is to be had.
ec_apt_get() {
  local as_root=(env)
  if [ "$(id --user)" -ne 0 ]; then
    { command -v sudo >/dev/null && sudo true; } ||
      ec_fail "not root, and no way in by sudo; as root (or EC_NO_INSTALL=1 where you have them in another way):" \
        "apt-get update && apt-get install --no-install-recommends $*"
    as_root=(sudo env)
  fi
  # apt's status has a descriptor of its own, made here, since sudo closes all others: apt 3 hands that of its status
  # to no child, and packages whose scripts print would fail where it is stdout.
  local apt=("${as_root[@]}" LC_ALL=C DEBIAN_FRONTEND=noninteractive
    sh -c 'exec "$@" 3>&1' sh apt-get -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300)
  local attempt
  for attempt in 1 2 3; do
    if "${apt[@]}" --quiet=2 update && ec_tell_size "${apt[@]}" -- "$@" &&
      ec_apt_install "${apt[@]}" -- "$@"; then return 0; fi
    [ "$attempt" -eq 3 ] || { echo "apt-get failed (attempt $attempt of 3); once more in 5 s" >&2 && sleep 5; }
  done
  ec_fail "apt-get could not install: $*" \
    "(names are of Debian 11 to 13 and sid, and of Ubuntu 20.04 with ROS Noetic; EC_NO_INSTALL=1 goes on without)"
}

# ec_apt_install APT_GET... -- PACKAGE...: installs, and counts how far it has come.
ec_apt_install() {
  local apt=()
  while [ "$1" != -- ]; do apt+=("$1") && shift; done
  shift
  (set -o pipefail &&
    "${apt[@]}" --yes --quiet=2 -o APT::Status-Fd=3 install --no-install-recommends "$@" |
    ec_count 's/^dlstatus:[^:]*:([0-9]+).*/fetching \1/p; s/^pmstatus:[^:]*:([0-9]+).*/installing \1/p')
}

# ec_tell_size APT_GET... -- PACKAGE...: says what apt-get would fetch, and how much the disk will hold of it.
ec_tell_size() {
  local apt=()
  while [ "$1" != -- ]; do apt+=("$1") && shift; done
  shift
  # Not --assume-no: apt asks nothing, and installs, where nothing comes along.
  "${apt[@]}" --print-uris --yes install --no-install-recommends "$@" 2>&1 |
    grep --extended-regexp '^([0-9]+ upgraded|Need to get|After this operation|E: )' || true
}
