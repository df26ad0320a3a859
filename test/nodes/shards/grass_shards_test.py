#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two nodes that share a meadow are one world: their hashes add up to that of a node with all tiles,
requests through either node have the same effect, and one cover map shows both."""
import math
import os
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Header
from vegetation_sim.msg import ErrorCode, GrassColour, GrassColours, GrassCut, GrassState, TreadEvent

from forest_rig import time_of
from grass_rig import Meadow, step
from waiting import SimulatedClock, wait_for
from watched_node import Log, publisher, slave

RATE, FIRST = 20, 20000
MASK = (1 << 64) - 1


def points(*places):
    return [Point(x, y, 0.0) for x, y in places]


def header(stamp):
    return Header(stamp=stamp, frame_id='map')


class GrassShards(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = Meadow('/whole/grass_field', '/whole/')
        cls.shards = [Meadow('/grass_0'), Meadow('/grass_1')]
        cls.nodes = cls.shards + [cls.whole]
        cls.state = Log('/grass/state', GrassState)
        cls.cover = Log('/grass/cover', OccupancyGrid)
        cls.whole_cover = Log('/whole/grass/cover', OccupancyGrid)
        cls.tread = publisher('/tread', TreadEvent)
        cls.clock, cls.tick = SimulatedClock(), FIRST
        cls.clock.wait_for_listeners(4)  # this process too
        wait_for(lambda: cls.tread.get_num_connections() == 3, 'readers of /tread')
        wait_for(lambda: len(cls.state._subscriber.impl.connections) == 2, 'both states')
        cls.run_ticks(2)
        for node in cls.nodes:
            node.reconnect()

    @classmethod
    def next_tick(cls, more=1):
        return time_of(cls.tick + more, RATE)

    @classmethod
    def run_ticks(cls, ticks):
        """Advances until all three nodes have sent their states."""
        for _ in range(ticks):
            cls.tick += 1
            stamp = time_of(cls.tick, RATE)
            cls.clock.set(stamp + rospy.Duration(0.5 / RATE))
            cls.state.wait(lambda all, s=stamp: len({m.shard for m in all[-4:]
                                                     if m.header.stamp == s}) == 2, str(stamp))
            cls.whole.state.wait_for_stamp(stamp)

    def send(self, *treads):
        """Publishes treads for the next tick, and returns when all nodes have them."""
        for tread in treads:
            tread.header = header(self.next_tick())
            self.tread.publish(tread)
        for node in self.nodes:
            node.settle()

    def ask(self, node, service, **request):
        answer = getattr(node, service)(**request)
        self.assertTrue(answer.success, answer.message)
        return answer

    def check_hashes(self):
        """Returns the number of different hashes of key frames, whose sums are equal."""
        sums, shards = {}, {}
        for message in self.state.messages:
            if message.key_frame:
                sums[message.header.stamp] = (sums.get(message.header.stamp, 0) + message.hash) & MASK
                shards.setdefault(message.header.stamp, set()).add(message.shard)
                self.assertEqual(message.shards, 2)
        whole = self.whole.hashes()
        checked = {stamp: hash_ for stamp, hash_ in whole.items() if len(shards.get(stamp, ())) == 2}
        for stamp, hash_ in checked.items():
            self.assertEqual(sums[stamp], hash_, stamp)
        return len(set(checked.values()))

    def test_1_are_one_meadow(self):
        for i in range(80):
            angle = 0.08 * i
            self.send(*[step('walker_%d' % k, 18.0 * math.sin(angle + k), 18.0 * math.sin(
                1.7 * angle + 2 * k), law={'radius': 0.3, 'reach': 0.8}) for k in range(3)])
            if i == 20:  # through the one and the other; the swath is beyond the border
                for node in (self.shards[1], self.whole):
                    self.ask(node, 'tread', header=header(self.next_tick(2)),
                             points=points((-15.0, -14.0), (16.0, 15.0), (16.0, -15.0)))
            if i == 30:
                for node in (self.shards[0], self.whole):
                    cut = GrassCut(outline=points((-8.0, -6.0), (8.0, 6.0)), radius=2.0, height=0.1,
                                   swath=points((-12.0, 2.0), (12.0, 2.0), (0.0, 12.0)))
                    self.ask(node, 'cut', header=header(self.next_tick(2)), cut=cut)
            if i == 60:
                centre = PointStamped(header=Header(frame_id='map'), point=Point(2.0, 0.0, 0.0))
                for node in (self.shards[1], self.whole):
                    self.ask(node, 'clear', centre=centre, radius=6.0)
            self.run_ticks(1)
        self.assertGreater(self.check_hashes(), 30)
        with_blocks = {m.shard for m in self.state.messages if m.blocks}
        with_cuts = {m.shard for m in self.state.messages if m.cuts}
        self.assertEqual((with_blocks, with_cuts), ({0, 1}, {0, 1}))

    def test_2_samples_are_alike(self):
        places = [(x, y) for x in range(-19, 20, 3) for y in range(-19, 20, 3)] + [(500.0, 0.0)]
        answers = [node.samples(places) for node in self.nodes]
        self.assertEqual(answers[0], answers[2])
        self.assertEqual(answers[1], answers[2])
        self.assertGreater(sum(sample.tilt > 0.0 for sample in answers[0]), 5)
        self.assertEqual([sample.inside for sample in answers[0]], [True] * (len(places) - 1) + [False])

    def test_3_one_cover_map_shows_all(self):
        self.run_ticks(4)

        def agree():
            pairs = [(a, b) for a in self.cover.messages for b in self.whole_cover.messages
                     if a.info.map_load_time == b.info.map_load_time and
                     a.header.stamp == b.header.stamp == time_of(self.tick, RATE)]
            self.run_ticks(1)
            return pairs and pairs[0]
        one, whole = wait_for(agree, 'cover maps of one tick')
        self.assertEqual(one.data, whole.data)
        self.assertGreater(sum(value > 0 for value in one.data), 100)
        self.assertEqual(len(self.cover._subscriber.impl.connections), 1)

    def test_4_late_treads_are_counted(self):
        def late(node):
            return node.diagnostics()['Treads after their tick']
        before = [late(node) for node in self.shards]
        tread = step('walker_0', 15.0, 15.0)
        tread.header = header(time_of(self.tick - 1, RATE))
        self.tread.publish(tread)
        for node in self.nodes:
            node.settle()
        self.assertIn(1.0, [late(node) - first for node, first in zip(self.shards, before)])
        self.run_ticks(1)

    def test_4_requests_without_a_stamp_act_at_one_tick(self):
        expected = self.next_tick(6)
        self.ask(self.shards[1], 'tread', points=points((0.5, -19.0), (0.5, 19.0)))
        self.run_ticks(10)
        at_once = {m.shard for m in self.state.messages if m.header.stamp == expected
                   for block in m.blocks for press in block.press
                   if m.press_stamps[press] == expected}
        self.assertEqual(at_once, {0, 1})

    def test_5_colours_reach_all_shards(self):
        places = [(-10.0, 3.0), (10.0, -3.0)]  # of both owners
        before = [node.samples(places) for node in self.shards]
        disc = GrassColour(x=0.0, y=0.0, radius=40.0, colour=1.0, weight=50.0)
        self.ask(self.shards[1], 'set_colours', colours=[disc])
        colours = Log('/grass/colours', GrassColours)
        colours.wait(lambda all: all and all[-1].colours == [disc], 'the disc', lambda: self.run_ticks(1))
        self.assertEqual(len(colours._subscriber.impl.connections), 1)
        self.run_ticks(2)
        for node, old in zip(self.shards, before):
            for was, now in zip(old, node.samples(places)):
                self.assertGreater(now.colour, was.colour + 0.2, (node.name, now.position))

    def test_6_a_silent_owner_is_named(self):
        _, _, process = slave('/grass_1').getPid('/test')
        os.kill(process, 9)
        answer = self.shards[0].cut(
            cut=GrassCut(outline=points((-8.0, -6.0), (8.0, 6.0)), radius=2.0, height=0.1))
        self.assertFalse(answer.success)
        self.assertEqual(answer.error_code, ErrorCode.NOT_AVAILABLE)
        # Its socket may close in the middle of the request.
        self.assertRegex(answer.message,
                         r'^shard 0: takes effect at \d+\.\d+ s; shard 1: shard 1 of 2, /grass_1, '
                         'does not answer ~cut: (it cannot be reached|the connection broke)')


if __name__ == '__main__':
    rospy.init_node('grass_shards_test')
    rostest.rosrun('vegetation_sim', 'grass_shards', GrassShards)
