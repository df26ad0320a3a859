#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""An explicit integrator does not run with steps beyond its stable step: diagnostics report it and
the tree keeps its shape (E12)."""
import math
import unittest

import rospy
import rostest

from forest_rig import RATE, TickClock
from grab_rig import TREE, Hands, vector

TWIG = 6
KEY = 'Steps too long for the integrator'


class LongSteps(unittest.TestCase):
    def test_they_are_reported_and_the_tree_keeps_its_shape(self):
        clock = TickClock(1000 * RATE)
        hands = Hands(clock)
        hands.wait_until_up()
        hands.run(1)
        self.assertEqual(hands.diagnostics()[KEY], 0)
        hands.take_at((0.05, 0.0, 0.0), TWIG, 0.1)
        hands.run(RATE)
        self.assertIn(TWIG, hands.physical())
        self.assertGreater(hands.diagnostics()[KEY], 0)
        for pose in hands.tree(TREE).transforms.poses:
            self.assertTrue(math.isfinite(sum(vector(pose.position))))
        hands.let_all_go()


if __name__ == '__main__':
    rospy.init_node('forest_long_steps_test')
    rostest.rosrun('vegetation_sim', 'forest_long_steps', LongSteps)
