# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# The system packages this package needs, and their installation. To be sourced; set -eu is expected.

# Names of Debian 11, 12 and 13. `ros-*` hold the message definitions, `lib*-msgs-dev` their headers.
EC_DEBIAN_PACKAGES=(
  # build
  g++ make cmake catkin ros-message-generation protobuf-compiler
  libroscpp-dev libnodelet-dev libnodeletlib-dev pluginlib-dev libtf2-dev libtf2-msgs-dev libtf2-geometry-msgs-dev
  libgeometry-msgs-dev libnav-msgs-dev libstd-msgs-dev libvisualization-msgs-dev
  ros-geometry-msgs ros-nav-msgs ros-std-msgs ros-visualization-msgs
  libboost-dev libboost-thread-dev libeigen3-dev libompl-dev libprotobuf-dev
  # run
  libnodeletlib-tools ros-message-runtime rosbash rviz
  python3-rosbag python3-roslaunch python3-rosnode python3-rosparam python3-rospy python3-rosservice python3-rostopic
  python3-tf2-ros python3-geometry-msgs python3-nav-msgs python3-std-msgs python3-visualization-msgs
  python3-numpy python3-protobuf python3-yaml
  netbase  # makes /etc/hosts where there is none, as in a bare chroot: ROS needs the name localhost
  # test
  catkin-lint libgtest-dev librostest-dev python3-rostest
)
# A picture of rviz: a display for where there is none, and what takes the screenshot.
EC_DEBIAN_PICTURE_PACKAGES=(xvfb x11-utils imagemagick libgl1-mesa-dri)

# Names of Ubuntu 20.04 with Noetic from packages.ros.org.
EC_NOETIC_PACKAGES=(
  g++ make cmake protobuf-compiler python3-catkin-lint python3-numpy python3-protobuf python3-yaml
  libboost-dev libboost-thread-dev libeigen3-dev libgtest-dev libompl-dev libprotobuf-dev
  ros-noetic-catkin ros-noetic-geometry-msgs ros-noetic-message-generation ros-noetic-message-runtime
  ros-noetic-nav-msgs ros-noetic-nodelet ros-noetic-pluginlib ros-noetic-rosbag ros-noetic-rosbash ros-noetic-roscpp
  ros-noetic-roslaunch ros-noetic-rosnode ros-noetic-rosparam ros-noetic-rospy ros-noetic-rosservice
  ros-noetic-rostest ros-noetic-rostopic ros-noetic-rviz ros-noetic-std-msgs ros-noetic-tf2
  ros-noetic-tf2-geometry-msgs ros-noetic-tf2-msgs ros-noetic-tf2-ros ros-noetic-visualization-msgs
)

# ec_install [--picture]: installs what is missing of the packages above; a fraction of a second where all is there.
ec_install() {
  local wanted=("${EC_DEBIAN_PACKAGES[@]}")
  [ ! -d /opt/ros/noetic ] || wanted=("${EC_NOETIC_PACKAGES[@]}")
  [ "${1-}" != --picture ] || wanted+=("${EC_DEBIAN_PICTURE_PACKAGES[@]}")
  local missing
  mapfile -t missing < <(ec_missing_packages "${wanted[@]}")
  [ "${#missing[@]}" -gt 0 ] || return 0
  echo "installing ${#missing[@]} of ${#wanted[@]} system packages (a few minutes for all): ${missing[*]}"
  ec_apt_get "${missing[@]}"
}

# Prints those of the named packages that are not installed, one per line.
ec_missing_packages() {
  command -v dpkg-query >/dev/null || ec_fail "this machine has no dpkg; install by hand what matches: $*"
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
      ec_fail "not root, and no way in by sudo; as root: apt-get install $*"
    as_root=(sudo env)
  fi
  local apt=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get --yes --quiet=2 -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300)
  local attempt
  for attempt in 1 2 3; do
    if "${apt[@]}" update && "${apt[@]}" install --no-install-recommends "$@" >/dev/null; then return 0; fi
    [ "$attempt" -eq 3 ] || { echo "apt-get failed (attempt $attempt of 3); once more in 5 s" >&2 && sleep 5; }
  done
  ec_fail "apt-get could not install: $*" "(names are of Debian 11 to 13, and of Ubuntu 20.04 with ROS Noetic)"
}
