#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Displays and lidars receive the trodden ground that they see, and no other; what they see is that
of a listener that receives all, and the ground does not depend on who listens."""
import math
import unittest

import rospy
import rostest
from vegetation_sim.msg import NearGrass, ScanReport

from forest_rig import TickClock, ViewerClient
from grass_rig import RATE, SIDE, Feet, Meadow, nodes_of, step, time_of
from scan_rig import LidarPair
from waiting import wait_for
from watched_node import Log

ORIGIN = -60.0  # of the meadow along x [m]
THERE = 500.0  # place of one of two walkers along x; the other is at 0
LIDAR = dict(rate=10, delay=0.1, noise=0.0, rings=12, columns=240, elevation_low=-0.5, elevation_high=0.0,
             range_max=20.0)
WAY = 25.0  # of the lidars to both sides, farther than the margin of a region [m]


def walked_on(nodes, spacing):
    """Returns whether there are nodes on the ways of both walkers."""
    sides = {ORIGIN + spacing * column > 0.5 * THERE for _, column in nodes}
    return (False in sides, True in sides)


class Ground:
    """The ground after all messages of a topic."""

    def __init__(self):
        self.nodes = {}

    def apply(self, state):
        if state.key_frame:
            self.nodes = {}
        self.nodes.update(nodes_of(state))

    def of(self, blocks):
        return {node: value for node, value in self.nodes.items()
                if (node[0] // SIDE, node[1] // SIDE) in blocks}


class GrassInterest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass, cls.unseen = Meadow(), Meadow('/unseen/grass_field', '/unseen/')
        cls.near = Log('/grass/near', NearGrass)
        cls.clock = TickClock(1000 * RATE)
        for meadow in (cls.grass, cls.unseen):
            meadow.wait_until_up()
        wait_for(cls.near.connected, cls.near.topic)
        cls.feet = Feet(cls.grass, readers=2)
        cls.spacing = cls.grass.layout.wait(lambda all: all and all[-1], 'a layout').tread_spacing
        cls.whole, cls.part, cls.taken, cls.walked = Ground(), Ground(), (0, 0), 0
        cls.clock.run(1, cls.grass, cls.unseen)

    @classmethod
    def run_ticks(cls, ticks):
        """Advances tick by tick while two walkers go their ways."""
        for _ in range(ticks):
            cls.walked += 1
            way = 10.0 * math.sin(0.02 * cls.walked)
            cls.feet.send(step('here', way, 2.0), step('there', THERE + way, 2.0))
            cls.unseen.settle()
            cls.clock.run(1, cls.grass, cls.unseen)
            stamp = time_of(cls.clock.tick)
            cls.near.wait(lambda all: all and all[-1].state.header.stamp == stamp, stamp)
        for message in cls.near.messages[cls.taken[0]:]:
            cls.part.apply(message.state)
        for message in cls.grass.state.messages[cls.taken[1]:]:
            cls.whole.apply(message)
        cls.taken = len(cls.near.messages), len(cls.grass.state.messages)

    def test_1_without_listeners_all_is_sent(self):
        self.run_ticks(40)
        self.assertEqual(self.near.messages[-1].discs, [])
        self.assertEqual(self.part.nodes, self.whole.nodes)
        self.assertEqual(walked_on(self.part.nodes, self.spacing), (True, True))

    def test_2_displays_receive_what_they_see(self):
        eye = ViewerClient(readers=1)
        for x in (0.0, THERE, 0.0):
            eye.move_to(x, 0.0, 2.0, self.grass)
            self.run_ticks(40)
            self.assertEqual(walked_on(self.part.nodes, self.spacing), (x == 0.0, x == THERE))
            blocks = {(row // SIDE, column // SIDE) for row, column in self.whole.nodes
                      if abs(ORIGIN + self.spacing * column - x) < 50.0}
            self.assertEqual(self.part.nodes, self.whole.of(blocks))
            self.assertGreater(len(blocks), 5)
            self.assertEqual(len(self.near.messages[-1].discs), 1)
        self.run_ticks(3 * RATE + 2)  # The viewer is silent.
        self.assertEqual(self.part.nodes, self.whole.nodes)
        eye.close()

    def test_3_lidars_measure_the_same_with_tracks_near_them(self):
        lidars = LidarPair('/grass_field', 'grass/state', 'grass/near', ['grass/layout'], **LIDAR)
        self.addCleanup(lidars.close)
        base = 0.0

        def place(sweep):
            return (base + WAY * math.sin(0.04 * sweep), 0.0, 1.2)

        for sweep in range(120):
            if sweep == 60:
                lidars.leave_whole(place(sweep), self.clock, lambda: self.run_ticks(1))
                self.assertEqual(walked_on(self.part.nodes, self.spacing), (True, False))
                base = THERE
            lidars.move(place(sweep), self.clock, lambda: self.run_ticks(1))
        compared, unequal = lidars.compare()
        self.assertGreater(len(compared), 100)
        self.assertEqual(unequal, [])
        self.assertGreater(lidars.scanners[0].report.messages[-1].counts[ScanReport.GRASS], 300)
        lidars.name_rival('/grass/near', NearGrass)

    def test_4_the_ground_does_not_depend_on_listeners(self):
        self.run_ticks(3 * RATE)
        self.clock.run(3 * RATE, self.grass, self.unseen)
        watched, unseen = self.grass.hashes(), self.unseen.hashes()
        stamps = set(watched) & set(unseen)
        self.assertGreater(len(stamps), 0)
        self.assertEqual({s: watched[s] for s in stamps}, {s: unseen[s] for s in stamps})


if __name__ == '__main__':
    rospy.init_node('grass_interest_test')
    rostest.rosrun('vegetation_sim', 'grass_interest', GrassInterest)
