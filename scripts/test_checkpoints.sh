#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Kills each node many times with -9 at random ticks, and compares the state hashes of runs that
# continue from checkpoints with those of a run without kills.
# usage: scripts/test_checkpoints.sh [KILLS [NODE ...]]  for each node, by default 50
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
export CHECKPOINT_KILLS=${1:-50}
nodes=("${@:2}")
[ ${#nodes[@]} -gt 0 ] || nodes=(wind grass canopy crowd forest)
use_space "$DEVEL"
export PATH=/usr/bin:$PATH
log=$(mktemp)
trap 'rm -f "$log"' EXIT

for node in "${nodes[@]}"; do
  say "$CHECKPOINT_KILLS kills: $node"
  # In a network of its own, no node of another run answers.
  unshare --user --map-root-user --net bash -c "ip link set lo up
    rostest --text test/nodes/snapshots/${node}_snapshot.test" >"$log" 2>&1 && grep "equal hashes" "$log" ||
    { cat "$log"; fail "$node: the hashes differ, or the test did not run"; }
done
