#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures what CanopyDisplay takes for a frame while leaves move, for the same plants with more and
# more faces: leaf by leaf, of which it draws 40000, and with pictures of the layers.
# usage: scripts/leaf_rates.sh [--seconds N] [--pictures FOLDER] [FACES ...]
#   FACES  numbers of faces of 625 plants together; 80000 5000000 50000000 by default
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

seconds=10 pictures=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --seconds) seconds=$2 ;;
    --pictures) pictures=$2 ;;
    *) fail "unknown option $1" ;;
  esac
  shift 2
done
numbers=("$@")
[ ${#numbers[@]} -gt 0 ] || numbers=(80000 5000000 50000000)
. "$ROOT/scripts/launching.sh"
prepare_frames

for faces in "${numbers[@]}"; do
  python3 "$ROOT/scripts/make_thicket.py" "$faces" "$WORK"
  start_roslaunch "$WORK/scene.launch"
  wait_until 120 'a message on canopy/state' topic_flows /canopy/state
  for tolerance in 0 1000; do
    sed "s/Picture Tolerance: .*/Picture Tolerance: $tolerance/" "$ROOT/bench/rviz/leaves.rviz" >"$WORK/leaves.rviz"
    say "$faces faces, $([ $tolerance = 0 ] && echo 'leaf by leaf' || echo pictures) (load $(cut -d ' ' -f 1 /proc/loadavg))"
    "$DEVEL/lib/vegetation_sim/rviz_frames" "$WORK/leaves.rviz" --settle 70 --seconds "$seconds" \
      ${pictures:+--picture "$pictures/leaves_${faces}_$tolerance.png"} 2>/dev/null | grep frames
  done
  stop_process "$launch_pid"
done
