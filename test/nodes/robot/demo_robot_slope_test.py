#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The robot of the demos stands on the ground: on a ramp it tilts, climbs slowly, descends fast, and
stays where it is without a command. Its odometry knows nothing of the slope."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from waiting import wait_for
from watched_node import Log, publisher

RISE = 0.3  # of the ramp to the east
SINE = RISE / math.hypot(1.0, RISE)
DROOP = 9.81 * SINE * 0.25  # by which the slope changes the speed of its motors [m/s]


def axis_of(pose, axis):
    """Returns the x (0) or z (2) axis of a pose in the world."""
    q = pose.orientation
    if axis == 0:
        return (1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z),
                2.0 * (q.x * q.z - q.w * q.y))
    return (2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
            1.0 - 2.0 * (q.x * q.x + q.y * q.y))


class DemoRobotSlope(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.odom, cls.truth = (Log(name, Odometry) for name in ('/odom', '/base_pose_ground_truth'))
        cls.commands = publisher('/cmd_vel', Twist)
        wait_for(lambda: cls.truth.messages and cls.pose().position.z < -2.0, 'a robot on the ramp')

    @classmethod
    def pose(cls):
        return cls.truth.messages[-1].pose.pose

    def drive(self, speed, spin, until, what):
        command = Twist()
        command.linear.x, command.angular.z = speed, spin

        def reached():
            self.commands.publish(command)
            return until()
        wait_for(reached, what)

    def speed(self):
        return self.truth.messages[-1].twist.twist.linear.x

    def check_pose(self):
        for message in self.truth.messages[-50:]:
            pose = message.pose.pose
            self.assertAlmostEqual(pose.position.z, RISE * pose.position.x, delta=0.01)
            for found, right in zip(axis_of(pose, 2), (-SINE, 0.0, math.sqrt(1.0 - SINE * SINE))):
                self.assertAlmostEqual(found, right, delta=0.01)

    def test_1_stands_on_the_slope_without_a_command(self):
        place = self.pose().position
        first = len(self.truth.messages)
        wait_for(lambda: len(self.truth.messages) > first + 50, 'a second')
        self.assertEqual(self.pose().position, place)
        self.check_pose()

    def test_2_climbs_slowly_and_descends_fast(self):
        self.drive(1.0, 0.0, lambda: abs(self.speed() - (1.0 - DROOP)) < 0.01, 'the speed of the climb')
        before = self.pose().position.x
        self.drive(1.0, 0.0, lambda: self.pose().position.x > before + 0.5, 'a climb')
        self.check_pose()
        self.assertAlmostEqual(axis_of(self.pose(), 0)[2], SINE, delta=0.01)
        self.drive(-1.0, 0.0, lambda: abs(self.speed() + 1.0 + DROOP) < 0.01, 'the speed of the descent')
        self.check_pose()

    def test_3_is_as_fast_across_the_slope_as_on_flat_ground(self):
        self.drive(0.0, 0.6, lambda: abs(axis_of(self.pose(), 0)[0]) < 0.02, 'a robot across the slope')
        self.drive(1.0, 0.0, lambda: abs(self.speed() - 1.0) < 0.03, 'the speed on flat ground')
        self.check_pose()

    def test_4_the_odometry_is_flat(self):
        for message in self.odom.messages:
            self.assertEqual(message.pose.pose.position.z, 0.0)
            self.assertEqual(axis_of(message.pose.pose, 2), (0.0, 0.0, 1.0))


if __name__ == '__main__':
    rospy.init_node('demo_robot_slope_test')
    rostest.rosrun('vegetation_sim', 'demo_robot_slope', DemoRobotSlope)
