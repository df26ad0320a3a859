#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Records media/demo.bag anew: five seconds of the scenario demo. It is made again when a message in it
# changes.
# usage: scripts/make_bag.sh
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

TOPICS=(/agents /canopy/layout /canopy/state /forest/forces /forest/layout /forest/view /grass/layout
  /grass/state /tf /tf_static /wind)

"$ROOT/scripts/build.sh"
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM
start_launch demo.launch scenario:=demo rviz:=false
wait_until 60 'a message on agents' topic_flows /agents
sleep 5
# A late subscriber gets complete states.
rosbag record --quiet --bz2 --duration=5 --output-name="$WORK/demo.bag" "${TOPICS[@]}"
mv "$WORK/demo.bag" "$ROOT/media/demo.bag"
say "Wrote $ROOT/media/demo.bag, $(stat -c %s "$ROOT/media/demo.bag") bytes"
