# shellcheck shell=bash
# Shared by the scripts in this folder, which source it first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# fail SENTENCE: the reason on stderr, and the end.
fail()
{
  echo "$1" >&2
  exit 1
}

# Another python3 may stand first on PATH (pyenv, conda); ROS needs the system's.
export PATH=/usr/sbin:/usr/bin:/sbin:/bin:$PATH

# source_ros FILE: reads a setup file of ROS, which knows no `set -u`.
source_ros()
{
  set +u
  # shellcheck source=/dev/null
  source "$1"
  set -u
}

# build_package TARGET...: configures once, then builds the targets into build/.
build_package()
{
  if [ -f /opt/ros/noetic/setup.bash ]; then source_ros /opt/ros/noetic/setup.bash; fi
  if [ ! -f build/Makefile ]; then
    # What a test may find is fixed now: of the devel space's folders, only those that exist.
    mkdir -p build/devel/lib/pkgconfig build/devel/lib/python3/dist-packages
    local launcher=
    if command -v ccache >/dev/null; then launcher=ccache; fi
    cmake -S . -B build -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" \
      -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3
  fi
  cmake --build build --parallel "$(nproc)" --target "$@"
}

# use_package FOLDER: makes rosrun and roslaunch find the devel or install space, with logs in build/ros_home
# and a ROS master of its own.
use_package()
{
  source_ros "$1/setup.bash"
  export ROS_HOME=$PWD/build/ros_home ROS_HOSTNAME=localhost ROSCONSOLE_STDOUT_LINE_BUFFERED=1 PYTHONUNBUFFERED=1
  ROS_MASTER_URI=http://localhost:$(free_port)
  export ROS_MASTER_URI
}

# answer_help MODULE ARGUMENT...: ends with the help of the Python module in this folder if an argument asks for it.
answer_help()
{
  local module=$1 argument
  shift
  for argument in "$@"; do
    if [[ $argument != -h && $argument != --help ]]; then continue; fi
    with_scripts /usr/bin/python3 -m "$module" --help 2>/dev/null ||
      fail "The help needs what scripts/setup installs: run it first."
    exit
  done
}

# run_module MODULE ARGUMENT...: runs the Python module in this folder with the package as it is built.
run_module()
{
  use_package build/devel
  with_scripts exec /usr/bin/python3 -m "$@"
}

# with_scripts COMMAND...: lets Python find the modules in this folder.
with_scripts()
{
  export PYTHONPATH="$PWD/scripts:${PYTHONPATH:-}"
  "$@"
}

# answer_header ARGUMENT...: ends with the comment at the script's head if an argument asks for help.
answer_header()
{
  local argument
  for argument in "$@"; do
    if [[ $argument != -h && $argument != --help ]]; then continue; fi
    sed -n '2,/^[^#]/s/^# \{0,1\}//p' "scripts/$(basename "$0")"
    exit
  done
}

# run_demo ARGUMENT...: launches the demo of the package in use. roslaunch hides how its processes ended,
# so its output tells.
run_demo()
{
  roslaunch ppf_bin_picking demo.launch "$@" 2>&1 | tee build/demo.log
  if grep -q 'exit code' build/demo.log; then fail "The demo failed: see build/demo.log."; fi
  grep -q '^Summary: ' build/demo.log || fail "The demo ended without a summary: see build/demo.log."
  echo "The demo ended as it should: no pick was wrong."
}

# free_port: a TCP port that nothing listens on.
free_port()
{
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'
}
