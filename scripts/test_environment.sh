#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Checks that scripts/environment.sh gives nodes an address where the name of the machine does not
# resolve, and keeps an address that the user has set.
set -euo pipefail

# usage: expect NAME ADDRESS [VARIABLE=VALUE]. Fails unless ROS_IP is ADDRESS on a machine called NAME.
expect() {
  local found
  found=$(env -u ROS_IP -u ROS_HOSTNAME "${@:3}" bash -euc '
    name=$1
    uname() { echo "$name"; }
    . "$2/environment.sh"
    echo "${ROS_IP:-}"' bash "$1" "$(dirname "$0")")
  [ "$found" = "$2" ] || { echo "machine $1 ${*:3}: ROS_IP is '$found', not '$2'" >&2; exit 1; }
}

expect no-such-machine.invalid 127.0.0.1
expect no-such-machine.invalid '' ROS_HOSTNAME=robot
expect no-such-machine.invalid 10.0.0.1 ROS_IP=10.0.0.1
expect 127.0.0.1 ''
