#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs all nodes while they are killed, stopped and flooded, the clock jitters, frames are lost and
# topics have second publishers. Checks memory, gaps between ticks, whether the diagnostics name each
# fault, and the final hashes against replays of the accepted events in quiet. To be run before a
# release; an hour of simulated time takes 26 minutes on two busy cores. Nodes are killed in the first
# third only, while all other faults go on. Once each of these has met the last processes, since every
# kind of flood needs its memory once, nodes rest now and then, and memory is measured meanwhile.
# usage: scripts/test_chaos.sh [SECONDS [SEED [FACTOR]]]  of simulated time (3600), of the faults (1),
# and the speed of the clock relative to real time (3)
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
use_space "$DEVEL"
export PATH=/usr/bin:$PATH ROS_HOSTNAME=localhost PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH=$ROOT/test/nodes/rigs:$PYTHONPATH
# In a network of its own, no node of another run answers.
unshare --user --map-root-user --net bash -c "ip link set lo up
  exec python3 test/chaos/run_chaos.py '${1:-3600}' '${2:-1}' '${3:-3}'"
