#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Checks which packages scripts/install_dependencies.sh chooses on each system, and that it fails with
# the name of the system on one that is not supported. Installs nothing.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# usage: install_on ID CODENAME [OPTION ...]. Runs the script as if this were another system.
install_on() {
  printf 'ID=%s\nVERSION_CODENAME=%s\nPRETTY_NAME="The system %s %s"\n' "$1" "$2" "$1" "$2" >"$folder/os-release"
  OS_RELEASE=$folder/os-release "$ROOT/scripts/install_dependencies.sh" "${@:3}"
}

# usage: expect_packages ID CODENAME WITH WITHOUT [OPTION ...]. WITH and WITHOUT are lists of packages.
expect_packages() {
  local package packages
  packages=$(install_on "$1" "$2" --list "${@:5}")
  for package in $3; do
    grep -qx -- "$package" <<<"$packages" || fail "$2 ${*:5}: $package is not among the packages"
  done
  for package in $4; do
    ! grep -qx -- "$package" <<<"$packages" || fail "$2 ${*:5}: $package is among the packages"
  done
}

# usage: expect_error TEXT ID CODENAME [OPTION ...]
expect_error() {
  local error
  ! error=$(install_on "${@:2}" 2>&1) || fail "$3 ${*:4}: succeeds"
  grep -qF -- "$1" <<<"$error" || fail "$3 ${*:4}: the error '$error' does not contain '$1'"
}

display='libgl-dev libgl1-mesa-dri libopengl-dev xauth xdotool xvfb'
expect_packages debian bullseye "g++ make rviz librviz-dev qtbase5-dev $display" 'libhwy-dev catkin-lint'
for release in bookworm trixie; do
  expect_packages debian $release "g++ libhwy-dev rviz librviz-dev $display" catkin-lint
  expect_packages debian $release 'g++ libhwy-dev libroscpp-dev libtopic-tools-dev' "rviz librviz-dev $display" --no-display
done
expect_packages debian bookworm 'rviz qtbase5-dev catkin-lint clang-tidy' '' --checks
expect_packages debian trixie 'qt6-base-dev qt6-svg-plugins' qtbase5-dev
expect_packages debian trixie '' qt6-base-dev --no-display
expect_packages ubuntu focal "ros-noetic-roscpp ros-noetic-rviz qtbase5-dev $display" 'rviz libroscpp-dev libhwy-dev'
expect_packages ubuntu focal 'ros-noetic-roscpp ros-noetic-topic-tools' "ros-noetic-rviz $display" --no-display

expect_error 'The system fedora 40 is not supported' fedora 40
expect_error 'Debian 11, 12 and 13 and Ubuntu 20.04' debian buster
expect_error 'unknown option --display' debian bookworm --display
