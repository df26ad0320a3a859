#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests grass_field while the clock waits, stops, runs, jumps back and jumps ahead (N6, S2-28)."""
import unittest

import rospy
import rostest

from forest_rig import TickClock, scene, stop
from grass_rig import FULL, RATE, Feet, Meadow, nodes_of, start_meadow, time_of

START = 1700000000 * RATE  # Unix time, at which single precision has no fraction of a second left


class GrassClock(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.clock = TickClock(START)
        cls.grass.wait_until_up()
        cls.before_time = list(cls.grass.state.messages)
        cls.feet = Feet(cls.grass)
        cls.clock.run(1, cls.grass)

    def test_nothing_happens_before_time_begins(self):
        self.assertEqual(self.before_time, [])

    def test_nothing_rises_while_the_clock_stands(self):
        self.feet.walk(self.clock, 'a', (0.0, 0.0), (2.0, 0.0), RATE)
        self.clock.run(10 * RATE, self.grass)
        held, count = self.grass.at(1.0, 0.0), len(self.grass.state.messages)
        self.assertTrue(0.5 < held.tilt < FULL)
        for _ in range(60):
            self.clock.show(self.clock.tick)
            self.grass.settle()
        self.assertEqual(self.grass.at(1.0, 0.0), held)
        self.assertEqual(len(self.grass.state.messages), count)
        self.clock.run(1, self.grass)
        self.assertLess(self.grass.at(1.0, 0.0).tilt, held.tilt)

    # After the jump the hashes are those of a node that starts at that time with the same inputs.
    def test_ten_seconds_back_is_a_fresh_start(self):
        self.feet.walk(self.clock, 'a', (0.0, 5.0), (8.0, 5.0), 10 * RATE)
        self.assertGreater(self.grass.at(4.0, 5.0).tilt, 1.0)
        jumps = self.grass.diagnostics()['Clock jumps back']
        self.clock.show(self.clock.tick - 10 * RATE)
        last = self.grass.state.wait_for_stamp(time_of(self.clock.tick))
        self.assertTrue(last.key_frame)
        self.assertEqual((last.sequence, nodes_of(last)), (0, {}))
        self.assertEqual(self.grass.at(4.0, 5.0).tilt, 0.0)
        after = len(self.grass.state.messages)
        process = start_meadow('/fresh/grass_field', {'tread': '/tread'}, scenario=scene('lawn'))
        fresh = Meadow('/fresh/grass_field', '/fresh/')
        try:
            fresh.wait_until_up('/tread')
            self.feet.walk(self.clock, 'b', (0.0, 6.0), (8.0, 7.0), 5 * RATE, fresh)
        finally:
            stop(process)
            fresh.close()
        hashes = {m.header.stamp: m.hash for m in self.grass.state.messages[after:] if m.key_frame}
        theirs = fresh.hashes()
        common = sorted(set(hashes) & set(theirs))
        self.assertGreater(len({hashes[s] for s in common}), 1)
        self.assertEqual([hashes[s] for s in common], [theirs[s] for s in common])
        self.assertEqual(self.grass.diagnostics()['Clock jumps back'], jumps + 1)

    def test_a_jump_ahead_is_counted_and_recovery_goes_on(self):
        self.feet.walk(self.clock, 'c', (-8.0, -5.0), (-6.0, -5.0), RATE)
        pressed = self.grass.at(-7.0, -5.0)
        dropped, before = self.grass.diagnostics()['Ticks dropped'], self.clock.tick
        self.clock.show(before + 30 * RATE)
        self.grass.state.wait_for_stamp(time_of(self.clock.tick))
        self.assertEqual(self.grass.diagnostics()['Ticks dropped'], dropped + 30 * RATE - 1)
        s = (pressed.age + 30.0) / 60.0  # share of the recovery time that has passed
        risen = FULL * (1.0 - s * s * (3.0 - 2.0 * s))
        self.assertAlmostEqual(self.grass.at(-7.0, -5.0).tilt, risen, delta=0.02)


if __name__ == '__main__':
    rospy.init_node('grass_clock_test')
    rostest.rosrun('vegetation_sim', 'grass_clock', GrassClock)
