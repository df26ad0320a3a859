#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A grab that a full forest rejects at its tick is removed and does not wait (N12)."""
import unittest

import rospy
import rostest

from forest_rig import RATE, TickClock, time_of
from grab_rig import LIMB, OTHER_LIMB, Hands, vector


class ForestRoom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands = Hands(cls.clock)
        cls.clock.begin(cls.hands)

    def test_a_grab_that_its_tick_refuses_is_over(self):
        first, _ = self.hands.take_at((0.1, 0.0, 0.0), LIMB, 0.1)
        self.hands.run(2)
        self.assertEqual(self.hands.physical(), [LIMB])
        refused = self.hands.diagnostics()['Inputs refused']
        # The service cannot reject it before its tick, because a branch may become free.
        second, _ = self.hands.take_at((0.0, 0.0, 0.0), OTHER_LIMB, 0.1,
                                       stamp=time_of(self.clock.tick + 3))
        self.assertIn('held are %d, %d' % (first.id, second.id),
                      self.hands.release(id=second.id + 1).message)
        self.hands.run(4)
        self.assertEqual(self.hands.diagnostics()['Inputs refused'], refused + 1)
        self.assertIn('held are %d' % first.id, self.hands.release(id=second.id).message)
        self.assertEqual(self.hands.physical(), [LIMB])

    def test_the_last_wrench_of_a_released_grab_is_zero(self):
        held, _ = self.hands.take_at((0.1, 0.0, 0.0), LIMB, 0.1)
        self.hands.run(RATE // 2)
        self.assertGreater(max(map(abs, vector(self.hands.wrench().wrench.force))), 1.0)
        self.hands.release(id=held.id)
        self.hands.run(1)
        self.assertEqual(vector(self.hands.wrench().wrench.force), (0.0, 0.0, 0.0))
        count = len(self.hands.wrenches.messages)
        self.hands.run(3)
        self.assertEqual(len(self.hands.wrenches.messages), count)

    def tearDown(self):
        self.hands.let_all_go()


if __name__ == '__main__':
    rospy.init_node('forest_room_test')
    rostest.rosrun('vegetation_sim', 'forest_room', ForestRoom)
