#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A frame or an odometry that a node is configured to follow and that does not arrive is a warning
on /diagnostics and one line on the console, which name it, until it arrives."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log as ConsoleLine
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import WindPrimitive
from vegetation_sim.srv import SetWindPrimitive

from forest_rig import RATE, TickClock, time_of
from waiting import DEADLINE, wait_for
from watched_node import Log, listens, publisher, wait_for_readers

NODES = ('/wind_broadcaster', '/forest_animator', '/grass_field', '/agent_crowd', '/vegetation_scanner',
         '/vegetation_camera')


class MissingFrames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.tf = publisher('/tf', TFMessage)
        cls.odom = publisher('/odom', Odometry)
        cls.reports = Log('/diagnostics', DiagnosticArray)
        cls.console = Log('/rosout', ConsoleLine)
        wait_for_readers('/clock', *NODES)
        wait_for_readers('/tf', *(node for node in NODES if node != '/wind_broadcaster'))
        wait_for_readers('/odom', '/grass_field')
        own = rospy.get_name()
        for topic in '/rosout', '/diagnostics':
            wait_for(lambda: listens(own, topic), topic)

    def warnings_of(self, node):
        """Returns the texts of the warnings among the newest statuses of a node."""
        newest = {s.name: s for m in list(self.reports.messages) for s in m.status
                  if s.name.startswith(node + ':')}
        return [s.message for s in newest.values() if s.level == DiagnosticStatus.WARN]

    def lines(self, node, sentence):
        return [m for m in list(self.console.messages)
                if m.level == ConsoleLine.WARN and m.msg == node + ': ' + sentence]

    def advance(self, *frames):
        """Publishes frames at the next tick, and the tick."""
        stamp = time_of(self.clock.tick + 1)
        for name in frames:
            frame = TransformStamped(child_frame_id=name)
            frame.header.frame_id, frame.header.stamp = 'map', stamp
            frame.transform.rotation.w = 1.0
            self.tf.publish(TFMessage([frame]))
        self.clock.run(1)

    def expect_reports(self, node, sentence, frame, again=lambda: None):
        def warned():
            self.advance()
            return any(sentence in text for text in self.warnings_of(node))
        wait_for(warned, 'a warning of ' + node)
        wait_for(lambda: self.lines(node, sentence), 'a line of ' + node)
        count = len(self.reports.messages)
        wait_for(lambda: warned() and len(self.reports.messages) > count + 3 * len(NODES),
                 'further reports')
        self.assertEqual(len(self.lines(node, sentence)), 1)

        def arrived():
            self.advance(frame)
            again()
            return not any(sentence in text for text in self.warnings_of(node))
        wait_for(arrived, 'a report of %s without the warning' % node)

    def test_a_body_of_the_forest(self):
        self.expect_reports('forest_animator', "no transform from 'arm' to 'map'", 'arm')

    def test_a_source_of_the_grass(self):
        self.expect_reports('grass_field', "no transform from 'wheel_left' to 'map'", 'wheel_left')

    def test_odometry_of_the_grass(self):
        self.expect_reports('grass_field', "no odometry on 'odom'", 'wheel_left',
                            lambda: self.odom.publish(self.odometry('odom')))
        self.expect_reports('grass_field', "no transform from 'odom' to 'map'", 'odom',
                            lambda: self.odom.publish(self.odometry('odom')))

    def odometry(self, frame):
        message = Odometry()
        message.header.frame_id, message.header.stamp = frame, time_of(self.clock.tick)
        message.pose.pose.orientation.w = 1.0
        return message

    def test_a_robot_of_the_crowd(self):
        self.expect_reports('agent_crowd', "no transform from 'base_link' to 'map'", 'base_link')

    def test_the_lidar_without_a_subscriber(self):
        self.expect_reports('vegetation_scanner', "no transform from 'lidar' to 'map'", 'lidar')

    def test_the_camera_without_a_subscriber(self):
        self.expect_reports('vegetation_camera',
                            "no transform from 'camera_optical_frame' to 'map'",
                            'camera_optical_frame')

    def test_a_sample_frame_of_the_wind(self):
        self.expect_reports('wind_broadcaster', "no transform from 'mast' to 'map'", 'mast')
        # It is reported again once its transform is stale.
        wait_for(lambda: self.advance() or any("'mast'" in text for text in
                                               self.warnings_of('wind_broadcaster')), 'a warning')

    def test_a_source_of_the_wind(self):
        rotor = WindPrimitive(name='rotor', kind=WindPrimitive.BLAST, radius=6.0, core_radius=1.0,
                              speed=20.0, fade_in=0.5, fade_out=0.5, attached_frame='drone')
        self.advance()  # Services are advertised once time has begun.
        rospy.wait_for_service('/wind_broadcaster/set_primitive', DEADLINE)
        answer = rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(rotor)
        self.assertTrue(answer.success, answer.message)
        wait_for_readers('/tf', '/wind_broadcaster')
        self.expect_reports('wind_broadcaster', "no transform from 'drone' to 'map'", 'drone')


if __name__ == '__main__':
    rospy.init_node('missing_frames_test')
    rostest.rosrun('vegetation_sim', 'missing_frames', MissingFrames)
