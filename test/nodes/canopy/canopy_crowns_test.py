#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests crowns with canopy leaves on trees of the forest: a branch that is held moves its leaves
(S3-W2), and the lidar sees them (N1)."""
import unittest

import rospy
import rostest
from visualization_msgs.msg import MarkerArray

from canopy_rig import Leaves
from forest_rig import RATE, TickClock, time_of
from grab_rig import LIMB, Hands, minus, size, vector
from scan_rig import Mast, Scanner
from watched_node import Log

PULL = (0.15, 0.0, 0.05)


class CanopyCrowns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands, cls.leaves = Hands(cls.clock), Leaves()
        cls.markers = Log('/canopy/markers', MarkerArray)
        cls.leaves.wait_until_up('/wind')
        cls.scanner = Scanner()
        cls.scanner.wait_until_up('/canopy/layout', '/canopy/state', '/forest/layout', '/forest/state')
        cls.clock.begin(cls.hands)
        cls.mast = Mast(cls.scanner)

    def run_all(self):
        self.clock.run(3, self.hands, self.leaves)

    def test_the_lidar_sees_the_leaves(self):
        def seen(reports):
            return reports and reports[-1].leaves == 2000

        def turn():
            self.mast.put(-4.0, 0.0, 2.0, time_of(self.clock.tick + 3))
            self.run_all()
        self.scanner.report.wait(seen, 'a sweep with the leaves of the crown', turn)

    def newest(self):
        """Returns the points of the leaves as soon as there are some."""
        def drawn(all_markers):
            points = [vector(p) for p in all_markers[-1].markers[3].points] if all_markers else []
            return points if sum(size(p) > 0.0 for p in points) > 6000 else None
        return self.markers.wait(drawn, 'leaves', self.run_all)

    def test_a_branch_that_is_held_takes_its_leaves_along(self):
        held = self.hands.point(LIMB, 0.3)
        before = self.newest()
        near = [i for i, p in enumerate(before) if size(minus(p, held)) < 0.3]
        self.assertGreater(len(near), 10)
        self.hands.take_at(PULL)

        def carried(all_markers):
            now = [vector(p) for p in all_markers[-1].markers[3].points]
            ways = [size(minus(a, b)) for a, b in zip(before, now)]
            return ways if max(ways[i] for i in near) > 0.08 else None
        ways = self.markers.wait(carried, 'leaves that go with the limb', self.run_all)
        still = sum(way < 0.02 for way in ways)
        self.assertGreater(still, len(ways) // 4)  # The leaves of other limbs do not move.
        self.assertLess(max(ways), 0.6)


if __name__ == '__main__':
    rospy.init_node('canopy_crowns_test')
    rostest.rosrun('vegetation_sim', 'canopy_crowns', CanopyCrowns)
