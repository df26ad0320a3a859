#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""People push the plants of canopy_animator as they were at the tick before, for which a tick
waits."""
import threading
import time
import unittest

import rospy
import rostest
from vegetation_sim.msg import AgentState, AgentStates, CanopyEvent

from canopy_rig import Leaves
from forest_rig import RATE, TickClock, time_of
from watched_node import publisher, wait_for_readers

BEGIN = 1000 * RATE


class CanopyPeople(unittest.TestCase):
    def setUp(self):
        self.leaves, self.clock = Leaves(), TickClock(BEGIN)
        self.clock.begin(self.leaves)
        self.agents = publisher('/agents', AgentStates)
        wait_for_readers('/agents', self.leaves.process)

    def send(self, tick, x=0.0):
        """Sends one person among the plants at a tick."""
        agent = AgentState(id=7, radius=0.25, height=1.8)
        agent.pose.position.x, agent.pose.orientation.w = x, 1.0
        message = AgentStates(agents=[agent])
        message.header.frame_id, message.header.stamp = 'map', time_of(tick)
        self.agents.publish(message)
        self.leaves.settle()

    def has_ticked(self):
        return self.leaves.state.messages[-1].header.stamp == time_of(self.clock.tick)

    def bodies(self):
        return [(e.header.stamp, e.body.stamp) for e in self.leaves.events.messages
                if e.kind == CanopyEvent.BODY]

    def late(self):
        return self.leaves.diagnostics()['People too late for their tick']

    def test_a_tick_takes_the_people_of_the_one_before(self):
        self.expect_people_of_the_tick_before()
        self.expect_a_tick_to_wait()
        self.expect_a_wait_to_end()

    def expect_people_of_the_tick_before(self):
        first = self.clock.tick
        for _ in range(5):
            self.send(self.clock.tick)
            self.send(self.clock.tick + 1, x=0.01)  # comes early and is not taken yet
            self.clock.run(1, self.leaves)
        expected = [(time_of(tick + 1), time_of(tick)) for tick in range(first, first + 5)]
        self.leaves.events.wait(lambda _: len(self.bodies()) >= 5, 'the events of 5 ticks')
        self.assertEqual(self.bodies(), expected)
        self.send(self.clock.tick)

    def expect_a_tick_to_wait(self):
        late = self.late()
        self.clock.run(1, self.leaves)
        self.clock.show(self.clock.tick + 1)
        threading.Event().wait(0.3)
        self.assertFalse(self.has_ticked())
        self.send(self.clock.tick - 1)
        self.leaves.state.wait_for_stamp(time_of(self.clock.tick))
        expected = time_of(self.clock.tick), time_of(self.clock.tick - 1)
        self.leaves.events.wait(lambda _: expected in self.bodies(), 'people of the tick before')
        self.assertEqual(self.late(), late)

    def expect_a_wait_to_end(self):
        late, start = self.late(), time.monotonic()
        self.clock.run(1, self.leaves)
        self.assertGreater(time.monotonic() - start, 1.9)
        self.assertEqual(self.late(), late + 1)
        self.agents.unregister()  # Nobody waits for people whom nobody publishes.
        start = time.monotonic()
        self.clock.run(RATE, self.leaves)
        self.assertLess(time.monotonic() - start, 10.0)
        self.assertEqual(self.leaves.diagnostics()['Bodies'], 0)


if __name__ == '__main__':
    rospy.init_node('canopy_people_test')
    rostest.rosrun('vegetation_sim', 'canopy_people', CanopyPeople)
