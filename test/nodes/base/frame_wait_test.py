#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""With frame_wait a tick uses the transform at its own stamp, although that comes after the clock."""
import threading
import unittest

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import CrowdEvent, ForestEvent, GrassEvent

from vegetation_sim.srv import Grab

from crowd_rig import Crowd
from forest_rig import RATE, Animator, TickClock, time_of
from grass_rig import Meadow
from watched_node import publisher, wait_for_readers

START = 1000 * RATE
TICKS = 20
STEP = 0.1  # motion of the robot in a tick [m]
GRABBED = 5  # tick after which the robot holds a trunk
DELAY = 0.05  # wall time between the clock and tf [s]
NODES = '/forest_animator', '/grass_field', '/agent_crowd'


class FrameWait(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.nodes = cls.forest, cls.grass, cls.crowd = Animator(), Meadow(), Crowd()
        cls.clock = TickClock(START)
        cls.tf = publisher('/tf', TFMessage)
        for topic in '/clock', '/tf':
            wait_for_readers(topic, *NODES)
        cls.publish(START)
        for tick in range(START + 1, START + TICKS):
            cls.clock.show(tick)
            threading.Event().wait(DELAY)
            cls.publish(tick)
            for node in cls.nodes:
                node.state.wait_for_stamp(time_of(tick), lambda: cls.clock.show(tick))
            if tick == START + GRABBED:
                grab = rospy.ServiceProxy('/forest_animator/grab', Grab)
                answer = grab(tree=0, branch=0, along=0.5, frame='robot', keep_offset=True)
                assert answer.success, answer.message

    @classmethod
    def publish(cls, tick):
        frame = TransformStamped(child_frame_id='robot')
        frame.header.frame_id, frame.header.stamp = 'map', time_of(tick)
        frame.transform.translation.x = STEP * (tick - START)
        frame.transform.rotation.w = 1.0
        cls.tf.publish(TFMessage([frame]))

    def expect_places(self, events, place_of):
        """Each event must have the place of the robot at the stamp of the event."""
        self.assertGreater(len(events), TICKS // 2)
        for event in events:
            x = STEP * RATE * (event.header.stamp - time_of(START)).to_sec()
            self.assertAlmostEqual(place_of(event).x, x, delta=1e-6)

    def test_bodies_are_where_they_are_at_the_tick(self):
        self.expect_places([e for e in self.forest.events.messages if e.kind == ForestEvent.BODY],
                           lambda event: event.body.pose.position)

    def test_grippers_are_where_they_are_at_the_tick(self):
        self.expect_places([e for e in self.forest.events.messages if e.kind in (ForestEvent.GRAB, ForestEvent.MOVE)],
                           lambda event: event.grab.holder.position)

    def test_sources_are_where_they_are_at_the_tick(self):
        self.expect_places([e for e in self.grass.events.messages if e.kind == GrassEvent.TREAD],
                           lambda event: event.tread.position)

    def test_robots_are_where_they_are_at_the_tick(self):
        self.expect_places([e for e in self.crowd.events.messages if e.kind == CrowdEvent.ROBOT],
                           lambda event: event.robot.position)

    def test_no_transform_is_late(self):
        for node in self.nodes:
            self.assertEqual(node.diagnostics()['Transforms too late for their tick'], 0)


if __name__ == '__main__':
    rospy.init_node('frame_wait_test')
    rostest.rosrun('vegetation_sim', 'frame_wait', FrameWait)
