#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the scene of scripts/test_shards.sh tick by tick: a lidar and a robot cross borders of
shards, walkers tread, and requests go through the wrong shard. Compares the sums of the hashes of
the shards with the hashes of the single nodes, and prints a table.

usage: drive_hosts.py TICKS SHARDS"""
import sys
import time

import rospy

from forest_rig import RATE, time_of
from scan_rig import cloud_of
from sharded_world import FIRST, Requests, World
from waiting import wait_for

WARM_UP = 1.0  # clouds are compared after this time [s]


def main():
    ticks, shards = int(sys.argv[1]), int(sys.argv[2])
    rospy.init_node('drive_hosts')
    world = World(shards)
    for _ in range(5):
        world.show_frames()
        world.run_tick()
    for kind in world.states:
        for node in ['/%s_%d' % (kind, i) for i in range(shards)] + ['/whole/%s_all' % kind]:
            rospy.wait_for_service(node + '/reset', 60.0)
    wait_for(world.is_joined, 'shards to find each other')
    requests, begin = Requests(world), time.monotonic()
    for age in range(ticks):
        world.show_frames()
        world.walk()
        requests.act(age)
        world.run_tick()
    seconds = time.monotonic() - begin
    print('%-10s %8s %8s %10s %14s %14s' % ('state', 'ticks', 'equal', 'hashes', 'shards [B/s]', 'one node [B/s]'))
    good = True
    for kind, (divided, whole) in world.states.items():
        both, equal, hashes = world.compare(kind)
        good = good and len(both) >= ticks and equal == both
        rate = RATE / (ticks + 5.0)
        print('%-10s %8d %8d %10d %14.0f %14.0f' % (
            kind, len(both), len(equal), hashes, divided.bytes * rate,
            whole.bytes * rate))
        if equal != both:
            print('first difference %d ticks after the start' % round(
                (min(set(both) - set(equal)) - time_of(FIRST)).to_sec() * RATE))
    # The first sweeps come before all shards know where the lidars are.
    begun = time_of(FIRST) + rospy.Duration(WARM_UP)
    common = sorted(s for s in set(world.clouds[0]) & set(world.clouds[1]) if s > begun)
    alike = [s for s in common if cloud_of(world.clouds[0][s]).tobytes() == cloud_of(world.clouds[1][s]).tobytes()]
    print('%-10s %8d %8d' % ('clouds', len(common), len(alike)))
    print('%d requests through other shards; %.1f ms per tick' % (requests.sent, 1000.0 * seconds / ticks))
    good = good and len(common) > 0 and alike == common and requests.sent > 0
    sys.exit(0 if good else 1)


if __name__ == '__main__':
    main()
