# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What debhelper is told to make a .deb of this package for the ROS of this system. To be sourced after workspace.sh.

# The value of a tag of package.xml that has no attributes.
ec_of_manifest() { sed -n "s:.*<$1>\(.*\)</$1>.*:\1:p" "$EC_ROOT/package.xml" | head -n 1; }

# Joined as debian/control lists packages.
ec_comma_list() { printf '%s\n' "$@" | sort | paste --serial --delimiters , | sed 's:,:, :g'; }

# ec_write_debian FOLDER: writes FOLDER/debian. The packages are those of packages.sh, name and version of package.xml.
ec_write_debian() {
  local name=external-command prefix=/usr options=() maintainer
  local build=("${EC_DEBIAN_BUILD_PACKAGES[@]}") run=("${EC_DEBIAN_RUN_PACKAGES[@]}") watch=rviz
  if ec_is_noetic; then
    name=ros-noetic-external-command prefix=/opt/ros/noetic watch=ros-noetic-rviz
    build=("${EC_NOETIC_BUILD_PACKAGES[@]}") run=("${EC_NOETIC_RUN_PACKAGES[@]}")
    options=(-DCATKIN_BUILD_BINARY_PACKAGE=ON "-DCMAKE_PREFIX_PATH=$prefix")
  fi
  maintainer=$(sed -n 's:.*<maintainer email="\(.*\)">\(.*\)</maintainer>.*:\2 <\1>:p' "$EC_ROOT/package.xml")
  mkdir -p "$1/debian/source"
  echo "3.0 (native)" >"$1/debian/source/format"
  cat >"$1/debian/changelog" <<TEXT
$name ($(ec_of_manifest version)~$(ec_os_release VERSION_CODENAME)) unstable; urgency=medium

  * See CHANGELOG.rst.

 -- $maintainer  $(date --rfc-email)
TEXT
  cat >"$1/debian/control" <<TEXT
Source: $name
Section: misc
Priority: optional
Maintainer: $maintainer
Standards-Version: 4.6.2
Build-Depends: debhelper-compat (= 13), dh-python, $(ec_comma_list "${build[@]}")

Package: $name
Architecture: any
Depends: \${shlibs:Depends}, \${python3:Depends}, \${misc:Depends}, $(ec_comma_list "${run[@]}")
Suggests: $watch, $(ec_comma_list "${build[@]}")
Description: $(ec_of_manifest description)
 The gateway itself, its command-line client, a simulated vehicle with a demo map, and what a package with command
 processors of its own is compiled against.
TEXT
  cp "$EC_ROOT/LICENSE" "$1/debian/copyright"
  cat >"$1/debian/rules" <<TEXT
#!/usr/bin/make -f
%:
	dh \$@ --buildsystem=cmake --with python3

override_dh_auto_configure:
	dh_auto_configure -- -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=$prefix -DCATKIN_ENABLE_TESTING=OFF -DEC_RVIZ_PLUGINS=OFF \\
	  -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 ${options[*]} \$(EC_CMAKE_ARGS)

override_dh_shlibdeps:
	dh_shlibdeps -l\$(CURDIR)/debian/$name$prefix/lib
TEXT
  chmod +x "$1/debian/rules"
}

# ec_build_deb OUTPUT_FOLDER: makes the .deb of what lies in the checkout, and prints its path.
ec_build_deb() {
  local work=$EC_BUILD_DIR/package/source
  rm -rf "$work" && mkdir -p "$work" "$1"
  tar --create --directory "$EC_ROOT" --exclude=./build "--exclude=./.[!.]*" --exclude=__pycache__ . |
    tar --extract --directory "$work"
  ec_write_debian "$work"
  local log=$EC_BUILD_DIR/package/build.log
  # Debug symbols would double the time and make the largest file of all.
  (ec_source "$EC_UNDERLAY" && cd "$work" &&
    DEB_BUILD_OPTIONS="noautodbgsym parallel=$(ec_jobs)" DEB_CXXFLAGS_STRIP=-g DEB_CFLAGS_STRIP=-g \
      dpkg-buildpackage --build=binary --no-sign) >"$log" 2>&1 ||
    { tail -n 40 "$log" >&2 && ec_fail "dpkg-buildpackage failed; all it said is in $log"; }
  [ "$EC_BUILD_DIR/package" -ef "$1" ] || mv "$EC_BUILD_DIR"/package/*.deb "$1/"
  (cd "$1" && ls -t "$PWD"/*.deb | head -n 1)
}
