#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# try_platform.sh STEP...: one or more of test, catkin_make, catkin_build, install, package, in a system that has a clone in
# /work/external_command and may be spoilt. Prints a line `RESULT ...` for each step; the exit code is that of the worst.
set -u
clone=/work/external_command
workspace="/work/a workspace"
installed=/work/installed
source "$clone/scripts/lib/workspace.sh"
set +e
readonly TOLD_FAILURE=9

# say CODE TEXT...: ends the step.
say() {
  local code=$1
  shift
  if [ "$code" -eq 0 ]; then echo "RESULT $*" && exit 0; fi
  echo "RESULT FAILED $*"
  exit $TOLD_FAILURE
}

step_test() {
  "$clone/scripts/test" 2>&1 | tee /work/test.log
  local code=${PIPESTATUS[0]}
  local warnings
  # Of compilers, linkers, CMake and our Python; not of the installation, nor of what the system brings.
  warnings=$(cat /work/test.log "$clone/build/configure.log" |
    grep --extended-regexp '^CMake.*Warning|:[0-9]+: [A-Za-z]*[Ww]arning: |\bld: warning' |
    grep --extended-regexp --count --invert-match '^(/usr/|<string>)')
  say "$((code + warnings > 0))" "test: $(tail -n 1 /work/test.log), $warnings warnings"
}

# A workspace with a space in its path, in which nothing is built yet.
make_workspace() {
  rm -rf "$workspace" && mkdir -p "$workspace/src"
  git clone --quiet "$clone" "$workspace/src/external_command"
  ec_install
  ec_source "$EC_UNDERLAY"
  cd "$workspace" || exit 1
}

cmake_words() {
  mapfile -t words < <(xargs --no-run-if-empty printf '%s\n' <<<"${EC_CMAKE_ARGS-}")
  words+=(-DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3)
}

step_catkin_make() {
  make_workspace
  cmake_words
  catkin_make -j"$(ec_jobs)" "${words[@]}"
  say $? "catkin_make"
}

step_catkin_build() {
  ec_install catkin-tools 2>/dev/null || pip3 install --quiet catkin_tools
  command -v catkin >/dev/null || say 0 "catkin build: no catkin-tools here"
  make_workspace
  cmake_words
  catkin config --cmake-args "${words[@]}" >/dev/null && catkin build --no-status --jobs "$(ec_jobs)"
  say $? "catkin build"
}

# The install space, driven with sources and build folders out of sight.
step_install() {
  make_workspace
  cmake_words
  catkin_make -j"$(ec_jobs)" "${words[@]}" "-DCMAKE_INSTALL_PREFIX=$installed" install
  mv "$workspace" "$workspace.hidden"
  # shellcheck disable=SC2030
  local drive code
  drive=$(cd / && ec_source "$installed/setup.bash" && "$clone/scripts/lib/try_drive.sh")
  code=$?
  rm -rf "$workspace.hidden"
  say $code "install space: $drive"
}

step_package() {
  "$clone/scripts/package" --no-try /work/package
  say $? "package"
}

worst=0
for step in "$@"; do
  ("step_$step")
  case $? in
    0) ;;
    "$TOLD_FAILURE") worst=1 ;;
    *) worst=1 && echo "RESULT FAILED $step" ;;
  esac
done
exit $worst
