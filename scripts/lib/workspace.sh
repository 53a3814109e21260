# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Environment and build of this package in build/ of the checkout, shared by all scripts. To be sourced.
#
# A script that needs a built executable of this package is these lines:
#
#   set -eu
#   source "$(dirname "$(readlink --canonicalize "$0")")/lib/workspace.sh"
#   ec_install                          # what is missing of the system packages
#   ec_build coverage_benchmark         # make targets; with none: all but tests and benchmarks
#   ec_environment                      # ROS, and this package's own setup.bash
#   "$(ec_executable coverage_benchmark)" "$@"
#
# `ec_has_target NAME` tells whether there is such a make target. EC_BUILD_DIR sets another build folder,
# EC_CMAKE_ARGS more arguments for cmake (words, quoted as for a shell), EC_JOBS the number of compilers at once,
# EC_UNDERLAY the setup.bash of the ROS to build on, EC_NO_INSTALL=1 that nothing is installed.

EC_ROOT=$(readlink --canonicalize "$(dirname "${BASH_SOURCE[0]}")/../..")
EC_BUILD_DIR=${EC_BUILD_DIR:-$EC_ROOT/build}

ec_fail() {
  echo "error: $*" >&2
  exit 1
}

# shellcheck source=scripts/lib/packages.sh
source "$EC_ROOT/scripts/lib/packages.sh"

if ec_is_noetic; then EC_UNDERLAY=${EC_UNDERLAY:-/opt/ros/noetic/setup.bash}; fi
EC_UNDERLAY=${EC_UNDERLAY-}  # Debian's ROS lies in /usr, and has none

# ROS and catkin are written for the system's python3, which need not be the first on the PATH.
export PATH="/usr/bin:$PATH"
# Message code for Lisp, EusLisp and JavaScript is of no use here and takes half of the generation's time. Of these
# Debian has Lisp alone, and its cmake warns of the others.
if ec_is_noetic; then ROS_LANG_DISABLE=${ROS_LANG_DISABLE:-genlisp:geneus:gennodejs}; fi
export ROS_LANG_DISABLE=${ROS_LANG_DISABLE:-genlisp}

# Makes ROS known to this shell and, once built, this package.
ec_environment() {
  ec_source "$EC_UNDERLAY"
  ec_source "$EC_BUILD_DIR/devel/setup.bash"
}

# Sources a catkin setup file if there is one. Such files use unset variables, and read the arguments.
ec_source() {
  [ -f "$1" ] || return 0
  local setup_file=$1
  set --
  set +u
  # shellcheck disable=SC1090
  source "$setup_file"
  set -u
}

# One compiler per core, and no more than memory holds: a translation unit with OMPL or roscpp takes up to 1.5 GB.
ec_jobs() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
  local cores
  cores=$(nproc)
  local jobs=$((by_memory < cores ? by_memory : cores))
  echo "${EC_JOBS:-$((jobs > 0 ? jobs : 1))}"
}

# ec_build [TARGET...]: configures and builds; two scripts at a time wait for each other.
ec_build() {
  mkdir -p "$EC_BUILD_DIR"
  (
    flock 9
    ec_source "$EC_UNDERLAY"
    ec_configure
    cmake --build "$EC_BUILD_DIR" --parallel "$(ec_jobs)" --target "${@:-all}" -- --no-print-directory
  ) 9>"$EC_BUILD_DIR/.lock" || exit 1
}

# ec_build_counted [TARGET...]: the same for who wants to use what is built: a count in place of the compilers' words,
# which go to build.log in the build folder. Where the build fails the errors are shown.
ec_build_counted() {
  local log=$EC_BUILD_DIR/build.log
  mkdir -p "$EC_BUILD_DIR"
  (set -o pipefail && ec_build "$@" 2>&1 | tee "$log" | ec_count 's/^\[ *([0-9]+)%\].*/building \1/p') && return
  grep --extended-regexp --max-count=20 '(error|Error|\*\*\*):? ' "$log" >&2 || true
  ec_fail "the build failed; all it said is in $log"
}

# ec_count SED_SCRIPT: shows how far its input has come, as `building: 42 %, 3 min`. The script makes `building 42` of the
# lines that tell it, and prints them. On a terminal one line is written over, elsewhere there is one each 10 %.
ec_count() {
  local what percent shown='' begin=$SECONDS step=10 end='\n'
  if [ -t 1 ]; then step=1 end='\r'; fi
  while read -r what percent; do
    percent=$((percent - percent % step))
    [ "$shown" != "$what $percent" ] || continue
    if [ -t 1 ] && [ -n "$shown" ] && [ "${shown% *}" != "$what" ]; then echo; fi
    shown="$what $percent"
    # shellcheck disable=SC2059
    printf "%s: %d %%, %d min$end" "$what" "$percent" $(((SECONDS - begin) / 60))
  done < <(sed --unbuffered --quiet --regexp-extended "$1")
  if [ -t 1 ] && [ -n "$shown" ]; then echo; fi
}

# Waits for the end of another run of tests in this build folder: results and logs lie there under fixed names.
ec_one_at_a_time() {
  mkdir -p "$EC_BUILD_DIR"
  exec 8>"$EC_BUILD_DIR/.tests.lock"
  flock --nonblock 8 && return
  echo "tests run in $EC_BUILD_DIR already; waiting for their end (with another EC_BUILD_DIR both run at once)" >&2
  flock 8
}

# Configures quietly; cmake's output is kept in a file, and shown when it fails. A build folder that was configured with
# the same words is left to make, which calls cmake where a CMake file has changed: where gtest is built from source,
# each further configuration would compile everything anew.
# What is installed goes into .install/ of the build folder. Hidden, since roslaunch and rosrun look for files in all
# other folders of a package, its build folder too.
ec_configure() {
  local log=$EC_BUILD_DIR/configure.log more words
  mapfile -t more < <(xargs --no-run-if-empty printf '%s\n' <<<"${EC_CMAKE_ARGS-}")
  words=(-S "$EC_ROOT" -B "$EC_BUILD_DIR" --no-warn-unused-cli -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3
    "-DCMAKE_INSTALL_PREFIX=$EC_BUILD_DIR/.install" -DCMAKE_INSTALL_MESSAGE=NEVER -DEC_QUICK_BUILD=ON
    "${more[@]}")
  local record=$EC_BUILD_DIR/.configured
  if cmp --quiet "$record" <(printf '%s\n' "${words[@]}"); then return 0; fi
  rm -f "$record"
  cmake "${words[@]}" >"$log" 2>&1 || { cat "$log" >&2 && ec_fail "cmake could not configure $EC_ROOT (see above)"; }
  printf '%s\n' "${words[@]}" >"$record"
}

# Installs this package, and builds each package of examples/, with its tests, on that.
ec_build_examples() {
  ec_build install
  local underlay=$EC_BUILD_DIR/.install/setup.bash example
  for example in $(ec_examples); do
    EC_ROOT=$EC_ROOT/examples/$example EC_BUILD_DIR=$(ec_example_build_dir "$example") \
      EC_UNDERLAY=$underlay ec_build all tests
  done
}

# Prints the names of the packages in examples/.
ec_examples() { (cd "$EC_ROOT/examples" && printf '%s\n' */ | tr --delete /); }

ec_example_build_dir() { echo "$EC_BUILD_DIR/examples/$1"; }

# Is there a make target of this name? To be asked after a build.
ec_has_target() { cmake --build "$EC_BUILD_DIR" --target help | grep --quiet --line-regexp "\.\.\. $1"; }

# Prints the path of an executable of this package.
ec_executable() {
  local path=$EC_BUILD_DIR/devel/lib/external_command/$1
  [ -x "$path" ] || ec_fail "$path is not built; is $1 a target of CMakeLists.txt?"
  echo "$path"
}
