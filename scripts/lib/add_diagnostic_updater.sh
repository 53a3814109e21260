#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# add_diagnostic_updater.sh MIRROR: for a chroot of Ubuntu 20.04, whose own ROS lacks diagnostic_updater, which Noetic has.
# Installs a package with the headers of Debian's, which are all that is used of it, and an empty library in the place of
# Debian's, which is linked to a later roscpp.
set -eu
sources=/etc/apt/sources.list.d/diagnostic_updater.list
folder=$(mktemp --directory)
trap 'rm -rf "$sources" "$folder" && apt-get --quiet=2 update' EXIT
cd "$folder"

apt-get --quiet=2 install --no-install-recommends --yes g++ >/dev/null  # before there are those of another system
echo "deb [trusted=yes] $1 bookworm main" >"$sources"
apt-get --quiet=2 update
apt-get --quiet=2 --option APT::Sandbox::User=root download libdiagnostic-updater-dev
dpkg-deb --raw-extract libdiagnostic-updater-dev_*.deb package

library=$(find package -name libdiagnostic_updater.so)
rm "$library"
g++ -shared -x c++ /dev/null -o "$library"
sed --in-place '/^Depends:/d' package/DEBIAN/control
dpkg-deb --build package headers.deb >/dev/null
dpkg --install headers.deb >/dev/null
