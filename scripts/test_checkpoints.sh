#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Kills each node many times with -9 at random ticks, and compares the state hashes of runs that
# continue from checkpoints with those of a run without kills. vegetation_scanner, which has no state,
# is compared with a scanner that runs on, cloud by cloud.
# usage: scripts/test_checkpoints.sh [KILLS [NODE ...]]  for each node, by default 50
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
export CHECKPOINT_KILLS=${1:-50} VEGETATION_SIM_TIME_LIMIT=3600
nodes=("${@:2}")
[ ${#nodes[@]} -gt 0 ] || nodes=(wind grass canopy crowd forest scanner)
use_space "$DEVEL"
export PATH=/usr/bin:$PATH
log=$(mktemp)
trap 'rm -f "$log"' EXIT

for node in "${nodes[@]}"; do
  say "$CHECKPOINT_KILLS kills: $node"
  file=test/nodes/snapshots/${node}_snapshot.test
  [ "$node" != scanner ] || file=test/nodes/sensors/scan_kill.test
  # In a network of its own, no node of another run answers.
  unshare --user --map-root-user --net bash -c "ip link set lo up
    rostest --text $file" >"$log" 2>&1 && grep -E "equal (hashes|clouds)" "$log" ||
    { cat "$log"; fail "$node: the hashes differ, or the test did not run"; }
done
