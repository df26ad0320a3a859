#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Frames a second that rviz draws of scenarios in a window of 1280 x 900 on a virtual display: with our
# displays and with stock markers, one after the other beside the same nodes; and how much pictures
# change from frame to frame while the camera goes away.
# usage: scripts/frame_rates.sh [--seconds N] SCENARIO ...
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

seconds=10
if [ "${1:-}" = --seconds ]; then seconds=$2; shift 2; fi
use_space "$BUILD/devel"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM
start_display
for scenario in "$@"; do
  start_launch demo.launch scenario:="$scenario" rviz:=false
  wait_until 60 'a message on forest/state' topic_flows /forest/state
  config=$ROOT/rviz/$scenario.rviz
  [ -e "$config" ] || config=$ROOT/rviz/default.rviz
  say "$scenario, our displays"
  rosrun vegetation_sim rviz_frames "$config" --seconds "$seconds" --dolly 3 2>/dev/null
  say "$scenario, stock markers"
  rosrun vegetation_sim rviz_frames "$ROOT/rviz/markers.rviz" --seconds "$seconds" 2>/dev/null
  stop_process "$launch_pid"
done
