#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the scene of scripts/test_shards.sh tick by tick: a lidar and a robot cross borders of
shards, walkers tread, and requests go through the wrong shard. Compares the sums of the hashes of
the shards with the hashes of the single nodes, the forces on a body and a gripper, and the people of two crowds with
those of one, and prints a table.

Then the link of shard 1 is down for 5 s of wall time while the clock goes on, without treads and
requests.

usage: drive_hosts.py TICKS SHARDS [FOLDER]   with a folder of the pictures of two displays"""
import subprocess
import sys
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.msg import ConfigDescription
from vegetation_sim.srv import GetTree

from compared_outputs import Forces, People
from display_pictures import DisplayPictures
from forest_rig import RATE, time_of
from scan_rig import cloud_of
from sharded_world import FIRST, Requests, World
from waiting import wait_for

WARM_UP = 1.0  # clouds are compared after this time [s]
CUT, CALM, AFTER = 5.0, 60, 60  # time without a link [s]; ticks before it without treads, and after it
PAUSE = 0.05  # [s] after a tick without a link, so that there are fewer than treads are ahead
OTHERS = 7  # nodes beside forests and grass
CROWDS = '/crowd_0', '/crowd_1', '/whole/crowd_all'


class CutLink:
    """The link of the host of shard 1 is down, and what is said about it."""

    def __init__(self):
        self.said = set()
        rospy.Subscriber('/diagnostics', DiagnosticArray, self._on_diagnostics)
        subprocess.check_call(['ip', 'link', 'set', 'link_2', 'down'])
        self._asking = threading.Thread(target=self._ask)
        self._asking.start()

    def _on_diagnostics(self, message):
        self.said |= {'%s: %s' % (s.name, s.message) for s in message.status if 'no message for 3 s' in s.message}

    def _ask(self):
        get_tree = rospy.ServiceProxy('/forest_0/get_tree', GetTree)
        self.said |= {a.message for a in [get_tree(tree=i) for i in range(16)] if not a.success}

    def join(self):
        subprocess.check_call(['ip', 'link', 'set', 'link_2', 'up'])
        self._asking.join()

    def is_told(self, shards):
        """Returns whether all other shards have named shard 1, and a request to it was refused."""
        named = all(any(words.startswith('%s_%d: ' % (kind, i)) and '1 (/%s_1)' % kind in words for words in self.said)
                    for kind in ('forest', 'grass') for i in range(shards) if i != 1)
        return named and any(words.startswith('shard 1 of %d' % shards) for words in self.said)


def pass_partition(world, requests, shards):
    """Returns the number of ticks without the link, the time until the states of all of them have come
    after it is up again [s], and whether the other shards have reported it."""
    for _ in range(CALM):  # treads and requests with stamps ahead are done
        world.show_frames()
        world.run_tick()
    link, pause = CutLink(), threading.Event()
    begin, first = time.monotonic(), world.tick
    world.alive -= 1
    while time.monotonic() < begin + CUT:
        world.show_frames()
        world.run_tick()
        pause.wait(PAUSE)
    link.join()
    ticks = world.tick - first
    world.alive += 1
    begin = time.monotonic()
    world.wait_for_states()
    seconds = time.monotonic() - begin
    for age in range(AFTER):
        world.show_frames()
        world.walk()
        requests.act(age)
        world.run_tick()
    for words in sorted(link.said):
        print('while the link is down: ' + words)
    return ticks, seconds, link.is_told(shards)


def wait_for_crowds():
    """Waits until all crowds have joined their shards."""
    for name in CROWDS:
        rospy.wait_for_message(name + '/parameter_descriptions', ConfigDescription, 60.0)


def run_first_tick(world):
    """Runs the first tick, until all nodes have had it: time stands still meanwhile, and who hears of it
    late has the same first tick."""
    world.show_frames()
    world.run_tick()
    names = ['/%s_%d' % (kind, i) for kind in world.states for i in range(world.shards)]
    names += ['/whole/%s_all' % kind for kind in world.states]
    for name in (*names, *CROWDS):
        rospy.wait_for_service(name + '/reset', 60.0)


def main():
    ticks, shards = int(sys.argv[1]), int(sys.argv[2])
    rospy.init_node('drive_hosts')
    people, forces = People(), Forces()
    pictures = DisplayPictures(sys.argv[3]) if len(sys.argv) > 3 else None
    world = World(shards, others=OTHERS + (2 if pictures else 0))
    people.wait_for_links()
    forces.wait_for_links()
    wait_for_crowds()
    run_first_tick(world)
    for _ in range(4):
        world.show_frames()
        world.run_tick()
    wait_for(world.is_joined, 'shards to find each other')
    requests, begin = Requests(world), time.monotonic()
    for age in range(ticks):
        world.show_frames()
        world.walk()
        requests.act(age)
        world.run_tick()
    seconds = time.monotonic() - begin
    bytes_ = {kind: [states.bytes * RATE / (ticks + 5.0) for states in pair] for kind, pair in world.states.items()}
    last = world.stamp()
    *partition, told = pass_partition(world, requests, shards)
    print('%d ticks without the link; %.1f s after it is up all states have come' % tuple(partition))
    print('%-10s %8s %8s %10s %14s %14s' % ('state', 'ticks', 'equal', 'hashes', 'shards [B/s]', 'one node [B/s]'))
    good = told
    if not told:
        print('not all shards have reported the one without a link')
    for kind in world.states:
        both, equal, hashes = world.compare(kind)
        good = good and len(both) >= ticks + CALM + AFTER and equal == both
        print('%-10s %8d %8d %10d %14.0f %14.0f' % (kind, len(both), len(equal), hashes, *bytes_[kind]))
        if equal != both:
            print('first difference %d ticks after the start' % round(
                (min(set(both) - set(equal)) - time_of(FIRST)).to_sec() * RATE))
    both, equal, moved = people.compare(world.stamp())
    good = good and both >= ticks + CALM + AFTER and equal == both and moved > 0
    print('%-10s %8d %8d, %d people have come to shard 1' % ('people', both, equal, moved))
    both, equal, touches = forces.compare()
    good = good and both >= ticks + CALM + AFTER and equal == both and min(touches) > 0
    print('%-10s %8d %8d, %d on bodies and %d on grippers' % ('forces', both, equal, *touches))
    # The first sweeps come before all shards know where the lidars are. Without a link trees stand still.
    begun = time_of(FIRST) + rospy.Duration(WARM_UP)
    common = sorted(s for s in set(world.clouds[0]) & set(world.clouds[1]) if begun < s < last)
    alike = [s for s in common if cloud_of(world.clouds[0][s]).tobytes() == cloud_of(world.clouds[1][s]).tobytes()]
    print('%-10s %8d %8d' % ('clouds', len(common), len(alike)))
    if pictures:
        different, alike_pictures = pictures.compare()
        print('pictures of two displays: %.3f %% of the pixels differ' % (100.0 * different))
        good = good and alike_pictures
    print('%d requests through other shards; %.1f ms per tick' % (requests.sent, 1000.0 * seconds / ticks))
    good = good and len(common) > 0 and alike == common and requests.sent > 0
    sys.exit(0 if good else 1)


if __name__ == '__main__':
    main()
