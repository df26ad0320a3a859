#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Kills each node many times with -9 at random ticks, and compares the state hashes of runs that
# continue from checkpoints with those of a run without kills. To be run before a release.
# usage: scripts/test_checkpoints.sh [KILLS]  for each node, by default 50
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
export CHECKPOINT_KILLS=${1:-50}
set +u
. "$BUILD/devel/setup.bash"
set -u
export ROS_HOSTNAME=localhost PATH=/usr/bin:$PATH

for node in wind forest grass canopy crowd; do
  say "$CHECKPOINT_KILLS kills: $node"
  # A network of its own: no node of another run answers.
  unshare --user --map-root-user --net bash -c "ip link set lo up
    rostest --text test/nodes/snapshots/${node}_snapshot.test" | grep -E 'equal hashes|RESULT|FAIL|ERROR'
done
