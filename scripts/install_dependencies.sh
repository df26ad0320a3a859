#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Installs the missing packages on Debian 11, 12 and 13 and on Ubuntu 20.04 with ROS Noetic; fails on
# other systems. If all are installed, it does not use the network. docs/dependencies.md gives the
# reason for each package.
# usage: scripts/install_dependencies.sh [--checks] [--no-display] [--list]
#   --checks      also installs what the tests, the charts and the static checks need
#   --no-display  installs no rviz, Qt, OpenGL or virtual display; then the nodes are built alone
#   --list        prints the packages of this system and installs none
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

with_checks=false with_display=true list=false
for option in "$@"; do
  case $option in
    --checks) with_checks=true ;;
    --no-display) with_display=false ;;
    --list) list=true ;;
    *) fail "unknown option $option; known are --checks, --no-display and --list" ;;
  esac
done

COMMON=(
  cmake g++ libassimp-dev libeigen3-dev libgmock-dev liboctomap-dev libpng-dev libyaml-cpp-dev ninja-build pkg-config
  make  # catkin_make
  procps
)
# These packages compile the displays, give the demo a virtual display and take screenshots;
# xvfb-run needs xauth.
DISPLAY_COMMON=(imagemagick libgl-dev libgl1-mesa-dri libopengl-dev xauth xdotool xvfb)
DEBIAN=(
  # These packages compile the code.
  catkin python3-catkin-pkg ros-core-dev libroscpp-dev libtf2-ros-dev libsensor-msgs-dev liburdf-dev
  libtopic-tools-dev libcamera-calibration-parsers-dev libcamera-info-manager-dev
  libimage-transport-dev
  libvisualization-msgs-dev libdiagnostic-updater-dev
  libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure
  libnodeletlib-dev pluginlib-dev
  # These packages run the nodes and the tests and inspect topics.
  libnodeletlib-tools python3-rosbag python3-roslaunch python3-rosmsg python3-rosnode
  python3-rosparam python3-rosservice python3-rostest python3-rostopic rosbash librostest-dev
  python3-diagnostic-msgs python3-geometry-msgs python3-interactive-markers python3-nav-msgs
  python3-sensor-msgs python3-std-srvs python3-tf2-msgs python3-visualization-msgs
)
DISPLAY_DEBIAN=(librviz-dev rviz)
# Debian 13 builds rviz with Qt 6 and does not install the plugin that draws its icons.
QT5=(qtbase5-dev)
QT6=(qt6-base-dev qt6-svg-plugins)
NOETIC=(
  camera-calibration-parsers camera-info-manager catkin diagnostic-msgs diagnostic-updater dynamic-reconfigure geometry-msgs
  image-transport interactive-markers message-generation
  message-runtime nav-msgs nodelet pluginlib rosbag rosbash roscpp rosgraph rosgraph-msgs roslaunch roslib
  rosmsg rosnode rosparam rospy rosservice rostest rostopic sensor-msgs std-msgs std-srvs tf2
  tf2-msgs tf2-ros topic-tools urdf visualization-msgs
)
DISPLAY_NOETIC=(ros-noetic-rviz)
# Charts and scripts of the tests, and static checks.
CHECKS=(python3-matplotlib python3-numpy python3-pil catkin-lint clang-format clang-tidy doxygen)

# Tests give the description of another system.
OS_RELEASE=${OS_RELEASE:-/etc/os-release}
system=unknown name='this system'
if [ -e "$OS_RELEASE" ]; then
  # shellcheck disable=SC1090
  system=$(. "$OS_RELEASE" && echo "${ID:-} ${VERSION_CODENAME:-}")
  # shellcheck disable=SC1090
  name=$(. "$OS_RELEASE" && echo "${PRETTY_NAME:-$system}")
fi
packages=("${COMMON[@]}") display=("${DISPLAY_COMMON[@]}" "${DISPLAY_DEBIAN[@]}" "${QT5[@]}")
case $system in
  'debian bullseye') packages+=("${DEBIAN[@]}") ;;  # without Highway: CMake fetches it
  'debian bookworm') packages+=("${DEBIAN[@]}" libhwy-dev) ;;
  'debian trixie')
    packages+=("${DEBIAN[@]}" libhwy-dev)
    display=("${DISPLAY_COMMON[@]}" "${DISPLAY_DEBIAN[@]}" "${QT6[@]}")
    ;;
  'ubuntu focal')
    packages+=("${NOETIC[@]/#/ros-noetic-}")
    display=("${DISPLAY_COMMON[@]}" "${DISPLAY_NOETIC[@]}" "${QT5[@]}")
    ;;
  *) fail "$name is not supported: Debian 11, 12 and 13 and Ubuntu 20.04 are. Elsewhere install the packages in docs/dependencies.md and run scripts/build.sh." ;;
esac
! $with_display || packages+=("${display[@]}")
! $with_checks || packages+=("${CHECKS[@]}")
if $list; then
  printf '%s\n' "${packages[@]}" | sort
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done

as_root=()
# usage: run_as_root COMMAND ...
run_as_root() {
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "needs root or sudo for: $*"
    as_root=(sudo)
  fi
  "${as_root[@]}" "$@"
}

# roslaunch looks up localhost, which bare roots and some containers do not know.
getent hosts localhost >/dev/null ||
  run_as_root sh -c 'echo 127.0.0.1 localhost >>/etc/hosts'

if [ ${#missing[@]} -eq 0 ]; then
  say 'All dependencies are installed.'
  exit 0
fi

# Rewrites the status lines of apt, "dlstatus:NUMBER:PERCENT:TEXT" and "pmstatus:NAME:PERCENT:TEXT".
# The text of a download ends with the remaining time. A terminal shows the present line only.
show_progress() {
  local kind percent text phase shown='' last=0 end='\n'
  [ ! -t 1 ] || end='\033[K\r'
  while IFS=: read -r kind _ percent text; do
    case $kind in
      dlstatus) phase=Download ;;
      pmstatus) phase=Installation ;;
      *) continue ;;
    esac
    percent=${percent%%.*}
    if [ $phase != "$shown" ] || [ "$percent" -ge $((last + 2)) ]; then
      printf "[%s %d %%] %s$end" $phase "$percent" "$text"
      shown=$phase last=$percent
    fi
  done
}

say "Installing ${#missing[@]} packages and what they need: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run_as_root apt-get update -qq
[ "$system" != 'ubuntu focal' ] || apt-cache show ros-noetic-catkin >/dev/null 2>&1 ||
  fail 'apt knows no package of ROS Noetic: add its source first, see http://wiki.ros.org/noetic/Installation/Ubuntu'
run_as_root sh -c 'DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o APT::Status-Fd=3 "$@" 3>&1 >"$0" 2>&1' "$log" "${missing[@]}" | show_progress ||
  { tail -n 30 "$log" >&2; fail 'apt-get cannot install the packages above'; }
