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
"$ROOT/scripts/build.sh" all benches
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM
LP_NUM_THREADS=$(nproc) start_display

# usage: write_scene FACES. The plants fill the same picture, in rows behind each other.
write_scene() {
  python3 "$ROOT/scripts/make_thicket.py" "$1" "$WORK"
}

# usage: write_view TOLERANCE
write_view() {
  sed "s/Picture Tolerance: .*/Picture Tolerance: $1/" "$ROOT/bench/rviz/leaves.rviz" >"$WORK/leaves.rviz"
}

for faces in "${numbers[@]}"; do
  write_scene "$faces"
  start_roslaunch "$WORK/scene.launch"
  wait_until 120 'a message on canopy/state' topic_flows /canopy/state
  for tolerance in 0 1000; do
    write_view $tolerance
    say "$faces faces, $([ $tolerance = 0 ] && echo 'leaf by leaf' || echo pictures) (load $(cut -d ' ' -f 1 /proc/loadavg))"
    "$DEVEL/lib/vegetation_sim/rviz_frames" "$WORK/leaves.rviz" --settle 70 --seconds "$seconds" \
      ${pictures:+--picture "$pictures/leaves_${faces}_$tolerance.png"} 2>/dev/null | grep frames
  done
  stop_process "$launch_pid"
done
