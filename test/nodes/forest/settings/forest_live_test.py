#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests forest_animator with wall time."""
import unittest

import rospy
import rostest
from vegetation_sim.msg import ForestState, WindField

from forest_rig import RATE, SensorClient, time_of
from watched_node import Log

TICKS = 2 * RATE


class ForestLive(unittest.TestCase):
    # Two seconds of ticks lie on the grid of Unix time. None is missing and none is early.
    def test_state_comes_tick_by_tick(self):
        wind = Log('/wind', WindField)
        state = Log('/forest/state', ForestState)
        sensor = SensorClient()
        field = wind.wait(lambda all: all and all[-1], 'the wind')
        state.wait(lambda all: all and all[-1].wind_hash == field.hash, 'its adoption')
        sensor.move_to(-60.0, -10.0, 4.0)
        first = len(state.messages)
        state.wait(lambda all: len(all) >= first + TICKS, 'states')
        self.assertGreaterEqual(rospy.Time.now(), state.messages[-1].header.stamp)
        states = state.messages[first:first + TICKS]
        tick = int(round(states[0].header.stamp.to_sec() * RATE))
        self.assertEqual([m.header.stamp for m in states],
                         [time_of(tick + i) for i in range(TICKS)])
        self.assertEqual([m.sequence - states[0].sequence for m in states], list(range(TICKS)))
        self.assertTrue(any(m.trees for m in states), 'no sensor had an effect')


if __name__ == '__main__':
    rospy.init_node('forest_live_test')
    rostest.rosrun('vegetation_sim', 'forest_live', ForestLive)
