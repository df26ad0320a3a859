#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures the images per second that vegetation_camera publishes of scenarios, at 640 x 480 pixels,
# from the place of the camera of their rviz configurations: the picture alone, then all four
# images. The images are counted over N seconds of wall time while all nodes of the scenario run.
# usage: scripts/camera_rates.sh [--seconds N] SCENARIO ...
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

seconds=20
if [[ ${1:-} == --seconds ]]; then
  seconds=$2
  shift 2
fi
"$ROOT/scripts/build.sh"
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM

for scenario in "$@"; do
  config=$ROOT/rviz/$scenario.rviz
  world=$(sed -n 's/^ *Fixed Frame: //p' "$config")
  {
    echo "<launch><include file='\$(find vegetation_sim)/launch/demo.launch'>"
    echo "<arg name='scenario' value='$scenario'/><arg name='rviz' value='false'/></include>"
    echo "<node pkg='vegetation_sim' type='vegetation_camera' name='measured_camera'><rosparam>"
    # The rate is above what the camera reaches.
    echo "{frame_id: $world, camera_frame: measured_camera, width: 640, height: 480, rate: 60, threads: 2}"
    echo "</rosparam></node>"
    echo '</launch>'
  } >"$WORK/scenario.launch"
  start_roslaunch "$WORK/scenario.launch"
  wait_until 60 'a message on /wind' topic_flows /wind
  say "$scenario (load $(cut -d ' ' -f 1 /proc/loadavg))"
  python3 "$ROOT/scripts/count_images.py" "$config" "$seconds"
  stop_process "$launch_pid"
done
