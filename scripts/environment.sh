# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# The other scripts source this file. It sets the paths of the package and puts the system's Python
# first in PATH.
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD=${BUILD:-$ROOT/build}
# rosrun ignores programs below build/, so the development space is beside it.
DEVEL=${BUILD%/build}/devel
export PATH=/usr/bin:/usr/sbin:/bin:$PATH

# ROS Noetic is not in the folders where CMake and Python look.
if [ -z "${CMAKE_PREFIX_PATH:-}" ] && [ -e /opt/ros/noetic/setup.bash ]; then
  set +u
  # shellcheck disable=SC1091
  . /opt/ros/noetic/setup.bash
  set -u
fi

# Nodes connect to each other by the name of the machine. In containers it often does not resolve;
# then they use the loopback address.
if [ -z "${ROS_HOSTNAME:-}${ROS_IP:-}" ] && ! getent hosts "$(uname -n)" >/dev/null; then
  export ROS_IP=127.0.0.1
fi

say() { printf '== %s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# The generated setup files read variables that may be unset.
use_space() {
  set +u
  # shellcheck disable=SC1091
  . "$1/setup.bash"
  set -u
}
