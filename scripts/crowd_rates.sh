#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures what agent_crowd sends to one reader of agents, and to one of agents/view: bytes of a
# message, and megabytes per second at 30 ticks per second. The script sets the clock, so the load
# of the machine has no effect.
# usage: scripts/crowd_rates.sh [--walkers N] [--ticks N]
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

walkers=20000 ticks=30
while [ $# -gt 0 ]; do
  case $1 in
    --walkers) walkers=$2 ;;
    --ticks) ticks=$2 ;;
    *) fail "unknown option $1" ;;
  esac
  shift 2
done
"$ROOT/scripts/build.sh" agent_crowd
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM

# 90 square metres for each walker, as in size_bench.
half=$(python3 -c "print(round((90 * $walkers) ** 0.5 / 2, 1))")
cat >"$WORK/crowd.yaml" <<SCENARIO
frame_id: map
seed: 7
crowd:
  area: {min_x: -$half, max_x: $half, min_y: -$half, max_y: $half}
  groups: [{count: $walkers, x: 0, y: 0, spread: $half}]
SCENARIO
cat >"$WORK/crowd.launch" <<LAUNCH
<launch>
  <param name="/use_sim_time" value="true"/>
  <node pkg="vegetation_sim" type="agent_crowd" name="agent_crowd">
    <param name="scenario" value="$WORK/crowd.yaml"/>
    <param name="state_rate" value="30"/>
    <param name="tread" value="none"/>
    <param name="most_walkers" value="100000"/>
  </node>
</launch>
LAUNCH
start_roslaunch "$WORK/crowd.launch"
wait_until 120 'the topic agents' rostopic info /agents
for topic in /agents /agents/view; do
  python3 "$ROOT/scripts/count_bytes.py" "$topic" "$ticks" 30
done
