#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# try_package.sh DEB: installs a .deb of scripts/package into a system that may be spoilt, drives, and removes it again.
# The exit code is 0 where all of it worked; the last line says what.
set -eu

fail() {
  echo "error: $*" >&2
  exit 1
}
folder=$(dirname "$(readlink --canonicalize "$0")")
name=$(dpkg-deb --field "$1" Package)
apt=(env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 -o Dpkg::Use-Pty=0)

"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends bash-completion "$(readlink --canonicalize "$1")" >/dev/null
packages=$(dpkg-query --show --showformat '${db:Status-Status}\n' | grep --count '^installed$')
if [ -f /opt/ros/noetic/setup.bash ]; then set +u && . /opt/ros/noetic/setup.bash && set -u; fi
cd /

drive=$("$folder/try_drive.sh") || fail "$name does not drive: $drive"

share=/usr/share
[ ! -d /opt/ros/noetic ] || share=/opt/ros/noetic/share
checked=$(CMAKE_PREFIX_PATH=${CMAKE_PREFIX_PATH:-/usr} rosrun external_command check_map \
  "$share/external_command/maps/demo_town/base_map.bin") || fail "check_map says of the demo map: $checked"

# Debian's rosbash looks for the programs of /usr only where CMAKE_PREFIX_PATH names it.
completions=$(CMAKE_PREFIX_PATH=${CMAKE_PREFIX_PATH:-/usr} bash -c 'set +u
  . /usr/share/bash-completion/bash_completion
  for file in /usr/share/bash-completion/completions/rosrun /usr/share/rosbash/rosbash /opt/ros/noetic/share/rosbash/rosbash; do
    if [ -f "$file" ]; then . "$file" && break; fi
  done
  COMP_WORDS=(rosrun external_command "") COMP_CWORD=2
  $(complete -p rosrun | sed "s:.*-F *\([^ ]*\).*:\1:") && echo "${COMPREPLY[@]}"')
case $completions in *external_command_client*) ;; *) fail "rosrun is completed to: $completions" ;; esac

"${apt[@]}" purge --yes "$name" >/dev/null
left=$(find / -xdev \( -name '*external_command*' -o -name '*external-command*' \) -not -path '/proc/*' \
  -not -path "$folder/*" -not -path '/root/.ros/*' -not -path '/tmp/*' -not -path '/var/cache/apt/*')
[ -z "$left" ] || fail "removal leaves $left"
echo "$name $(dpkg-deb --field "$1" Version): installed among $packages packages, $drive, map checked, completed, removed"
