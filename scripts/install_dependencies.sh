#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Installs the missing packages that building, testing and the demo need on Debian 12. If all are
# installed, it does not use the network. docs/dependencies.md gives the reason for each package.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

PACKAGES=(
  # These packages compile the code.
  catkin cmake g++ ninja-build python3-catkin-pkg ros-core-dev
  libroscpp-dev libtf2-ros-dev libsensor-msgs-dev liburdf-dev libvisualization-msgs-dev
  libdiagnostic-updater-dev
  libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure
  libgl-dev libnodeletlib-dev pluginlib-dev librviz-dev qtbase5-dev
  libassimp-dev libeigen3-dev libhwy-dev libpng-dev libyaml-cpp-dev
  # These packages run the nodes.
  libnodeletlib-tools python3-matplotlib python3-numpy python3-pil rviz
  # These packages run the tests and inspect topics.
  python3-rosbag python3-roslaunch python3-rosmsg python3-rosnode python3-rosparam
  python3-rosservice python3-rostest python3-rostopic rosbash librostest-dev libgmock-dev
  python3-diagnostic-msgs python3-geometry-msgs python3-nav-msgs python3-sensor-msgs python3-std-srvs python3-tf2-msgs
  python3-visualization-msgs
  catkin-lint clang-format clang-tidy
  # These packages give the demo a virtual display and take screenshots.
  imagemagick libgl1-mesa-dri procps xdotool xvfb
)

if ! command -v dpkg-query >/dev/null || ! grep -q '^VERSION_CODENAME=bookworm' /etc/os-release; then
  say 'This system is not Debian 12: see docs/dependencies.md for its dependencies.'
  exit 0
fi

missing=()
for package in "${PACKAGES[@]}"; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  say 'All dependencies are installed.'
  exit 0
fi

say "Installing ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "needs root or sudo to install: ${missing[*]}"
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
