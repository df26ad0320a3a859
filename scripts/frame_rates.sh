#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Frames a second that rviz draws of scenarios in a window of 1280 x 900 on a virtual display: with our
# displays, beside the same nodes with stock markers as they are budgeted, with markers of about as many
# triangles as our displays draw, and with the finest markers that the nodes publish, for markers know no
# camera but the nodes'. And how much levels of detail change in pictures of our displays as the camera
# goes away.
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

# usage: start_scenario SCENARIO [MARKER_POINTS]
start_scenario() {
  local node
  {
    echo "<launch><include file='\$(find vegetation_sim)/launch/demo.launch'>"
    echo "<arg name='scenario' value='$1'/><arg name='rviz' value='false'/></include>"
    for node in ${2:+forest_animator grass_field canopy_animator agent_crowd}; do
      echo "<param name='$node/marker_points' value='$2'/>"
    done
    echo '</launch>'
  } >"$WORK/scenario.launch"
  start_roslaunch "$WORK/scenario.launch"
  wait_until 60 'a message on forest/state' topic_flows /forest/state
}

# usage: measure WHAT FILE.rviz [OPTION ...]
measure() {
  say "$scenario, $1 (load $(cut -d ' ' -f 1 /proc/loadavg))"
  "$BUILD/devel/lib/vegetation_sim/rviz_frames" "$2" --seconds "$seconds" "${@:3}" 2>/dev/null |
    grep 'frames' | tee "$WORK/figures"
}

for scenario in "$@"; do
  config=$ROOT/rviz/$scenario.rviz
  [ -e "$config" ] || config=$ROOT/rviz/default.rviz
  start_scenario "$scenario"
  measure 'our displays' "$config" --dolly 3
  triangles=$(sed -n 's/.* of \([0-9]*\) triangles.*/\1/p' "$WORK/figures")
  measure 'stock markers' "$ROOT/rviz/markers.rviz" --view "$config"
  stop_process "$launch_pid"
  for points in $((3 * triangles)) 3000000; do
    start_scenario "$scenario" "$points"
    measure "stock markers of up to $((points / 3)) triangles" "$ROOT/rviz/markers.rviz" --view "$config"
    stop_process "$launch_pid"
  done
done
