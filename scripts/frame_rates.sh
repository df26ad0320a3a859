#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures the frames per second that rviz draws of scenarios, in a window of 1280 x 900 on a
# virtual display. It measures
#   - the displays of this package,
#   - the same nodes with stock markers at their default budgets,
#   - markers at the rate of the displays with as many visible triangles as the displays show,
#   - the finest markers that the nodes publish.
# Markers are chosen for the camera of the node, not for that of rviz. The script also measures how
# much a change of level of detail changes the picture while the camera moves away.
# usage: scripts/frame_rates.sh [--seconds N] [--points N] SCENARIO ...
#   --points N  number of marker points that shows as many triangles; without it the script searches
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

seconds=10 given=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --seconds) seconds=$2 ;;
    --points) given=$2 ;;
    *) fail "unknown option $1" ;;
  esac
  shift 2
done
. "$ROOT/scripts/launching.sh"
prepare_frames
MOST=3000000   # limit of the points that a node may publish
UPDATE_RATE=30 # [Hz] update rate of the displays

# usage: start_scenario SCENARIO [MARKER_POINTS]
start_scenario() {
  local node
  {
    echo "<launch><include file='\$(find vegetation_sim)/launch/demo.launch'>"
    echo "<arg name='scenario' value='$1'/><arg name='rviz' value='false'/></include>"
    for node in ${2:+forest_animator grass_field canopy_animator agent_crowd}; do
      echo "<param name='$node/marker_points' value='$2'/>"
      echo "<param name='$node/markers_rate' value='$UPDATE_RATE'/>"
    done
    echo '</launch>'
  } >"$WORK/scenario.launch"
  start_roslaunch "$WORK/scenario.launch"
  wait_until 60 'a message on forest/state' topic_flows /forest/state
}

# usage: measure WHAT FILE.rviz [OPTION ...]
measure() {
  say "$scenario, $1 (load $(cut -d ' ' -f 1 /proc/loadavg))"
  "$DEVEL/lib/vegetation_sim/rviz_frames" "$2" --seconds "$seconds" "${@:3}" 2>/dev/null |
    grep 'frames' | tee "$WORK/figures"
}

# usage: markers_of POINTS. Starts the scenario with POINTS marker points, divided equally among all
# nodes that publish markers.
markers_of() {
  local parts
  parts=$(grep -cE '^(forest|grass|canopy|crowd):' "$ROOT/config/scenarios/$scenario.yaml") ||
    fail "$scenario has no plants or people"
  start_scenario "$scenario" $(($1 / parts))
  measure "stock markers of $1 points" "$ROOT/rviz/markers.rviz" --view "$config"
  stop_process "$launch_pid"
}

in_picture() { sed -n 's/.* \([0-9]*\) in the picture.*/\1/p' "$WORK/figures"; }

for scenario in "$@"; do
  config=$ROOT/rviz/$scenario.rviz
  [ -e "$config" ] || config=$ROOT/rviz/default.rviz
  start_scenario "$scenario"
  measure 'our displays' "$config" --dolly 3
  wanted=$(in_picture)
  [ "${wanted:-0}" -gt 0 ] || fail "the displays draw nothing of $scenario"
  measure 'stock markers' "$ROOT/rviz/markers.rviz" --view "$config"
  stop_process "$launch_pid"
  points=${given:-$((3 * wanted))}
  for ((try = 0; try < 3; ++try)); do
    markers_of "$points"
    [ -z "$given" ] || break
    shown=$(in_picture)
    [ "${shown:-0}" -gt 0 ] || fail "the markers of $points points show nothing of $scenario"
    ((10 * shown < 9 * wanted || 10 * shown > 11 * wanted)) || break
    points=$((points * wanted / shown))
    ((points <= MOST)) || points=$MOST
  done
  markers_of $MOST
done
