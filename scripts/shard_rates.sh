#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures the processor time and memory of forest and grass in 1, 2, 4 and 8 shards, in turn and
# in several rounds, of which the median counts. The memory is the proportional set size: resident
# memory in which pages that processes share, such as the code of libraries, count once in all, on
# average over the ticks and at its highest. It also measures the bytes that a display and a lidar
# receive with the same view in a world and in one of a quarter the size: a million trees, a square
# kilometre of grass and 2000 walkers. The script sets the clock, and takes half an hour.
# usage: scripts/shard_rates.sh [TILES [WALKERS [TICKS [AREA [RANGE [ROUNDS]]]]]]
#        (1024 tiles of 1000 trees, 2000, 300 ticks, TILES x 1000 m2 of grass, views of 100 m, 3)
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
use_space "$DEVEL"
export PATH=/usr/bin:/usr/sbin:/sbin:$PATH PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH=$ROOT/test/nodes/rigs:$ROOT/test/nodes/shards:$PYTHONPATH
tiles=${1:-1024} walkers=${2:-2000} ticks=${3:-300}
area=${4:-$((1000 * tiles))} range=${5:-100} rounds=${6:-3}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT

# usage: measure TILES WALKERS SHARDS [AREA PLACES RANGE]. In a network of its own, no node of another run answers.
measure() {
  unshare --user --map-root-user --net --pid --fork --kill-child --mount-proc bash -c "
    ip link set lo up
    export ROS_MASTER_URI=http://localhost:11311 ROS_HOSTNAME=localhost ROS_HOME='$WORK/ros'
    roscore >'$WORK/roscore.log' 2>&1 &
    until rosparam set /use_sim_time true 2>/dev/null; do sleep 0.2; done
    python3 test/nodes/shards/hosts/measure_shards.py '$WORK' $1 $2 $3 $ticks ${*:4} 2>'$WORK/errors.log'" ||
    { tail -n 20 "$WORK/errors.log" >&2; fail 'the measurement did not end'; }
}

for ((round = 0; round < rounds; ++round)); do
  for shards in 1 2 4 8; do measure "$tiles" "$walkers" "$shards"; done
done | tee "$WORK/rows"
python3 - "$WORK/rows" <<'END'
import collections
import re
import statistics
import sys

LIMIT = 1.15  # times the cost of one shard
QUANTITIES = (('processor time', 'ms', 'ms of processor time'), ('memory', 'MB', 'MB of memory'),
              ('highest memory', 'MB', 'MB at the highest'))
good = True
rows = open(sys.argv[1], encoding='utf-8').read().splitlines()
for quantity, unit, mark in QUANTITIES:
    # Successive rows of a number of shards are those of the forest and of the grass in one round.
    costs = collections.defaultdict(list)
    for row in rows:
        found = re.search(r'^(\d+) shards, .*?([\d.]+) ' + mark, row)
        if found:
            costs[int(found[1])].append(float(found[2]))
    sums = {shards: [sum(pair) for pair in zip(each[::2], each[1::2])] for shards, each in costs.items()}
    for shards, rounds in sorted(sums.items()):
        ratios = [cost / one for cost, one in zip(rounds, sums[1])]
        print('%d shards: %.1f %s, %.2f times the %s of one (%.2f to %.2f)' % (
            shards, statistics.median(rounds), unit, statistics.median(ratios), quantity, min(ratios), max(ratios)))
        good = good and statistics.median(ratios) <= LIMIT
sys.exit(0 if good else 'more than %g times the cost of one shard' % LIMIT)
END
echo 'One display and one lidar, in the world and in one of a quarter the size:'
for part in 1 4; do
  measure $((tiles / part)) $((walkers / part)) 2 $((area / part)) 1 "$range"
done | tee "$WORK/rows"
awk '/ display: | lidar: / { name = $5; sub(":", "", name); if (name in first)
  { ratio = first[name] / $6; printf "%s: %.3f times the bytes of the smaller world\n", name, ratio
    if (ratio > 1.2) bad = 1 }
  else first[name] = $6 }
  END { if (bad) print "more than 1.2 times the bytes of the smaller world"; exit bad }' "$WORK/rows"
