#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""forest_animator runs as a program and as nodelets, in several instances, is reset and restarted
(N6)."""
import signal
import subprocess
import unittest

import roslib.packages
import rospy
import rostest
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ForestEvent, ForestState

from forest_rig import RATE, Animator, SensorClient, TickClock, scene, start_animator, stop, time_of
from waiting import wait_for
from watched_node import Log

RESTARTS = 5
FIXED_LEVEL, OTHER_FIXED_LEVEL = 2, 3


class ForestInstances(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = Animator()
        cls.nodelet = Animator('/twin/forest_animator', '/twin/')
        cls.other = Animator('/other/forest_animator', '/other/')
        cls.other.state = Log('/other/levels', ForestState)  # The topic is remapped.
        for nodelet in (cls.nodelet, cls.other):
            nodelet.process = '/manager'
        cls.all = cls.program, cls.nodelet, cls.other
        cls.clock = TickClock(1000 * RATE)
        cls.clock.begin(*cls.all)
        cls.sensor = SensorClient(readers=2)

    def run_sensed(self, seconds, *animators):
        for half in range(2 * seconds):
            self.sensor.move_to(-20.0 + 10.0 * half, 0.0, 5.0, self.program, self.nodelet)
            self.clock.run(RATE // 2, *animators)

    def settle(self):
        self.clock.run(8 * RATE, *self.all)

    # The nodelet publishes the same data as the program, to the bit.
    def test_a_nodelet_is_the_twin_of_the_program(self):
        self.settle()
        start = self.clock.tick
        self.run_sensed(5, *self.all)
        layouts = [a.layout.messages[-1] for a in (self.program, self.nodelet)]
        self.assertEqual(layouts[0].hash, layouts[1].hash)
        self.assertEqual(layouts[0].species, layouts[1].species)
        expected, states = self.program.states(), self.nodelet.states()
        stamps = [time_of(start + 1 + i) for i in range(5 * RATE)]
        self.assertEqual([states[s] == expected[s] for s in stamps], [True] * len(stamps))
        self.assertTrue(any(m.trees for m in self.nodelet.state.messages[-5 * RATE:]))
        self.assertEqual(self.program.tree(3).transforms, self.nodelet.tree(3).transforms)

    # The instances do not share topics, services or settings.
    def test_instances_do_not_disturb_each_other(self):
        self.settle()
        before = self.other.state.messages[-1].hash
        self.run_sensed(3, *self.all)
        self.nodelet.set_tf(0, [1, 2], True)
        self.assertTrue(rospy.ServiceProxy('/twin/forest_animator/reset', Trigger)().success)
        self.clock.run(5, *self.all)
        self.assertEqual(self.other.state.messages[-1].hash, before)
        self.assertEqual(self.other.level(0), OTHER_FIXED_LEVEL)
        self.assertEqual(self.other.set_tf(0, [1], False).frames, 0)
        self.assertEqual([e.kind for e in self.other.events.messages if e.kind != ForestEvent.WIND],
                         [])

    def test_frames_of_instances_have_their_prefixes(self):
        frames = Log('/tf', TFMessage)
        for animator in (self.program, self.other):
            self.assertEqual(animator.set_tf(0, [1], True).frames, 1)
        wanted = {'tree_0/branch_1', 'other/tree_0/branch_1'}
        frames.wait(lambda all: wanted <= {t.child_frame_id for m in all for t in m.transforms},
                    'the frames', lambda: self.clock.run(1, *self.all))
        frames.close()
        for animator in (self.program, self.other):
            animator.set_tf(0, 'all', False)

    # After ~reset the forest is in its initial state from the next tick on.
    def test_reset_starts_anew(self):
        self.run_sensed(3, *self.all)
        self.assertTrue(any(m.trees for m in self.program.state.messages[-3 * RATE:]))
        self.program.set_tf(0, [1, 2], True)
        tick, sequence = self.clock.tick, self.program.state.messages[-1].sequence
        self.assertTrue(rospy.ServiceProxy('/forest_animator/reset', Trigger)().success)
        self.assertEqual(self.program.state.messages[-1].sequence, sequence)
        self.clock.run(1, *self.all)
        state = self.program.state.messages[-1]
        self.assertEqual((state.sequence, state.key_frame, state.base_level, state.trees),
                         (0, True, FIXED_LEVEL, []))
        event = self.program.events.wait_for_stamp(time_of(tick + 1))
        self.assertEqual(event.kind, ForestEvent.RESET)
        self.assertEqual(self.program.set_tf(0, 'all', False).frames, 0)

    def test_a_nodelet_that_refuses_is_not_loaded(self):
        rospy.set_param('/refused', {'tolerance': -1.0})
        nodelet = roslib.packages.find_node('nodelet', 'nodelet')[0]
        done = subprocess.run([nodelet, 'load', 'vegetation_sim/forest_animator', '/manager',
                               '__name:=refused'], timeout=60, stderr=subprocess.DEVNULL)
        self.assertNotEqual(done.returncode, 0)
        self.clock.run(1, *self.all)  # The other instances continue.

    # Subscribers recover: they get the layout again, then a key frame, then deltas without a gap.
    def test_readers_survive_restarts(self):
        reader = Animator('/mortal/forest_animator', '/mortal/')
        for i in range(RESTARTS):
            layouts = len(reader.layout.messages)
            process = start_animator('/mortal/forest_animator', {'wind': '/wind'},
                                     scenario=scene('grove'))
            reader.wait_until_up('/wind')
            first = len(reader.state.messages)
            self.clock.run(10 + i, *self.all, reader)
            reader.layout.wait(lambda all: len(all) > layouts, 'the layout')
            self.assertEqual(reader.layout.messages[-1].hash, self.program.layout.messages[-1].hash)
            states = reader.state.messages[first:]
            self.assertTrue(states[0].key_frame)
            self.assertEqual([m.sequence for m in states], list(range(10 + i)))
            self.assertEqual(reader.tree(4).skeleton_hash, self.program.tree(4).skeleton_hash)
            stop(process, signal.SIGKILL if i % 2 else signal.SIGINT)
            wait_for(lambda: not reader.state.connected(), 'the end of the node')
            reader.reconnect()
        reader.close()


if __name__ == '__main__':
    rospy.init_node('forest_instances_test')
    rostest.rosrun('vegetation_sim', 'forest_instances', ForestInstances)
