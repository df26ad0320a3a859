#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""N6: step_clock.py, started by its launch argument, lets time go on by a service as Simulation
does."""
import unittest

import rosnode
import rospy
import rostest
from std_srvs.srv import Trigger
from vegetation_sim import Crowd, Simulation
from vegetation_sim.msg import AgentStates, ErrorCode
from vegetation_sim.srv import Step

from waiting import wait_for
from watched_node import Log, serves

START = rospy.Time(1000)


def episode(crowd, step):
    """Runs an episode in which walkers get goals. `step(ticks)` returns the hash of the last tick.
    Returns all of them."""
    hashes = []
    for i in range(12):
        if i % 4 == 0:
            crowd.send([0, 1], (0.5 * i - 3.0, 5.0))
        hashes.append(step(5))
    return hashes


def has_clock():
    return any(topic == '/clock' for topic, _ in rospy.get_master().getSystemState()[2][0])


class StepClockTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for service in '/step_clock/step', '/step_clock/reset':
            wait_for(lambda: serves(service), service)
        cls.ask = rospy.ServiceProxy('/step_clock/step', Step)
        cls.ask_reset = rospy.ServiceProxy('/step_clock/reset', Trigger)
        cls.crowd = Crowd()

    def step(self, ticks):
        answer = self.ask(ticks=ticks)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.error_code, ErrorCode.NONE)
        return answer

    def reset(self):
        answer = self.ask_reset()
        self.assertTrue(answer.success, answer.message)

    def test_1_a_step_is_so_many_ticks(self):
        log = Log('/agents', AgentStates)
        wait_for(log.connected, 'people')
        answer = self.step(30)
        log.wait_for_stamp(answer.stamp)
        self.assertEqual(len(log.messages), 30)
        self.assertEqual(len({m.header.stamp for m in log.messages}), 30)
        self.assertEqual(answer.topics, ['/agents'])
        self.assertEqual(list(answer.hashes), [log.messages[-1].hash])
        self.assertEqual(self.step(30).stamp - answer.stamp, rospy.Duration(1))
        log.close()

    def test_2_a_bad_number_is_refused_with_its_range(self):
        before = self.step(1)
        for ticks in 0, 100001, 2 ** 32 - 1:
            answer = self.ask(ticks=ticks)
            self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.INVALID_VALUE))
            self.assertEqual(answer.message, 'ticks = %d is outside 1 to 100000' % ticks)
        self.assertEqual(self.step(30).stamp - before.stamp, rospy.Duration(1))

    def test_3_a_reset_begins_anew(self):
        self.reset()
        first = self.step(30)
        self.assertEqual(first.stamp - START, rospy.Duration(1))
        self.step(7)
        self.reset()
        again = self.step(30)
        self.assertEqual((again.stamp, list(again.hashes)), (first.stamp, list(first.hashes)))

    def test_4_hashes_are_those_of_simulation(self):
        self.reset()
        by_service = episode(self.crowd, lambda ticks: self.step(ticks).hashes[0])
        self.assertEqual(len(set(by_service)), len(by_service))
        rosnode.kill_nodes(['/step_clock'])
        wait_for(lambda: not has_clock(), 'no clock')
        simulation = Simulation({'agents': AgentStates})
        simulation.reset()
        direct = episode(self.crowd, lambda ticks: simulation.step(ticks)['/agents'].hash)
        self.assertEqual(direct, by_service)


if __name__ == '__main__':
    rospy.init_node('step_clock_test')
    rostest.rosrun('vegetation_sim', 'step_clock', StepClockTest)
