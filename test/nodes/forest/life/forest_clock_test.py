#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests forest_animator while the clock waits, stops, runs, jumps back and jumps ahead (N6)."""
import threading
import unittest

import rospy
import rostest

from vegetation_sim.srv import GetTree

from forest_rig import RATE, Animator, SensorClient, TickClock, scene, start_animator, stop, time_of
from waiting import DEADLINE
from watched_node import serves

START = 1700000000 * RATE  # Unix time, at which single precision has no fraction of a second left
SPEED = 20.0  # ratio of the fast clock to wall time
STEP = 0.05  # step of the fast clock [s]


class ForestClock(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.clock = TickClock(START)
        cls.forest.wait_until_up('/wind')
        cls.before_time = serves('/forest_animator/get_tree'), list(cls.forest.state.messages)
        early = rospy.ServiceProxy('/forest_animator/get_tree', GetTree)

        def ask():
            early.wait_for_service(DEADLINE)
            cls.early_answer = early(tree=0)
        client = threading.Thread(target=ask)
        client.start()
        cls.clock.begin(cls.forest)
        client.join()
        cls.sensor = SensorClient()

    def run_sensed(self, ticks, *animators):
        for tick in range(0, ticks, 15):
            self.sensor.move_to(-20.0 + 10.0 * tick / RATE, 0.0, 5.0, *animators)
            self.clock.run(15, *animators)

    def stamps_since(self, index):
        return [m.header.stamp for m in self.forest.state.messages[index:]]

    def expect_no_gap(self, index):
        sequences = [m.sequence for m in self.forest.state.messages[index:]]
        self.assertEqual(sequences, list(range(sequences[0], sequences[0] + len(sequences))))

    def test_nothing_happens_before_time_begins(self):
        self.assertEqual(self.before_time, (False, []))

    def test_a_client_that_waits_for_a_service_waits_for_the_first_tick(self):
        self.assertTrue(self.early_answer.success, self.early_answer.message)
        self.assertGreaterEqual(self.early_answer.transforms.header.stamp, time_of(START + 1))

    def test_nothing_moves_while_the_clock_stands(self):
        self.run_sensed(RATE, self.forest)
        count, poses = len(self.forest.state.messages), self.forest.tree(2).transforms
        for _ in range(60):
            self.clock.show(self.clock.tick)
            self.forest.settle()
        self.assertEqual(len(self.forest.state.messages), count)
        self.assertEqual(self.forest.tree(2).transforms, poses)
        self.clock.run(1, self.forest)
        self.assertNotEqual(self.forest.tree(2).transforms.poses, poses.poses)

    # After the jump the states are those of a node that starts at that time with the same inputs.
    def test_ten_seconds_back_is_a_fresh_start(self):
        self.run_sensed(10 * RATE, self.forest)
        jumps = self.forest.diagnostics()['Clock jumps back']
        self.clock.show(self.clock.tick - 10 * RATE)
        self.forest.state.wait_for_stamp(time_of(self.clock.tick))
        self.assertTrue(self.forest.state.messages[-1].key_frame)
        self.assertEqual(self.forest.state.messages[-1].sequence, 0)
        after = len(self.forest.state.messages)
        process = start_animator('/fresh/forest_animator',
                                 {'wind': '/wind', 'forest/sensors': '/forest/sensors'}, scenario=scene('grove'))
        fresh = Animator('/fresh/forest_animator', '/fresh/')
        try:
            fresh.wait_until_up('/wind', '/forest/sensors')
            self.run_sensed(5 * RATE, self.forest, fresh)
        finally:
            stop(process)
            fresh.close()
        states = self.forest.states(after)
        self.assertEqual(len(states), 5 * RATE)
        self.assertTrue(any(m.trees for m in self.forest.state.messages[after:]), 'no levels changed')
        self.assertTrue(states == fresh.states())
        self.assertEqual(self.forest.diagnostics()['Clock jumps back'], jumps + 1)

    def test_a_clock_at_20_times_real_time_misses_no_tick(self):
        self.clock.run(1, self.forest)
        first, before = self.clock.tick, len(self.forest.state.messages)
        dropped = self.forest.diagnostics()['Ticks dropped']
        pace = threading.Event()
        for i in range(int(20.0 / STEP)):
            self.clock.show_time(time_of(first) + rospy.Duration.from_sec(STEP * (i + 1)))
            pace.wait(STEP / SPEED)
        last = first + 20 * RATE
        self.clock.show(last)
        self.forest.state.wait_for_stamp(time_of(last))
        self.assertEqual(self.stamps_since(before),
                         [time_of(tick) for tick in range(first + 1, last + 1)])
        self.expect_no_gap(before)
        self.assertEqual(self.forest.diagnostics()['Ticks dropped'], dropped)

    def test_a_jump_ahead_is_counted_and_it_goes_on(self):
        self.run_sensed(RATE, self.forest)
        dropped, before = self.forest.diagnostics()['Ticks dropped'], self.clock.tick
        index = len(self.forest.state.messages)
        self.clock.run(1, self.forest)
        self.clock.show(before + 1000 * RATE)
        self.forest.state.wait_for_stamp(time_of(self.clock.tick))
        self.clock.run(RATE, self.forest)
        self.assertEqual(self.stamps_since(index), [time_of(before + 1)] + [
            time_of(before + 1000 * RATE + i) for i in range(RATE + 1)])
        self.expect_no_gap(index)
        self.assertEqual(self.forest.diagnostics()['Ticks dropped'], dropped + 1000 * RATE - 2)


if __name__ == '__main__':
    rospy.init_node('forest_clock_test')
    rostest.rosrun('vegetation_sim', 'forest_clock', ForestClock)
