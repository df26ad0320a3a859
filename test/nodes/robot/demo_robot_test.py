#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the robot of the demos: its odometry drifts from its true pose, which tf has as the frame
world below base_link."""
import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist, WrenchStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from waiting import wait_for
from watched_node import Log, publisher

WAY = 2.0  # [m]


def pose_of(pose):
    """Returns x, y [m] and yaw [rad] of a pose or a transform in the plane."""
    at = getattr(pose, 'position', None) or pose.translation
    turn = getattr(pose, 'orientation', None) or pose.rotation
    return at.x, at.y, 2.0 * math.atan2(turn.z, turn.w)


def way_of(messages):
    """Returns the length of the way and the sum of the turns of odometry messages."""
    poses = [pose_of(m.pose.pose) for m in messages]
    return (sum(math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(poses, poses[1:])),
            sum(math.remainder(b[2] - a[2], 2.0 * math.pi) for a, b in zip(poses, poses[1:])))


class DemoRobot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.odom, cls.truth = (Log(name, Odometry) for name in ('/odom', '/base_pose_ground_truth'))
        cls.frames = Log('/tf', TFMessage)
        cls.diagnostics = Log('/diagnostics', DiagnosticArray)
        cls.command, cls.wrench = (publisher(name, kind) for name, kind in
                                   (('/cmd_vel', Twist), ('/grass/wrenches', WrenchStamped)))
        for log in cls.odom, cls.truth, cls.frames:
            wait_for(lambda: log.messages, log.topic)
        command = Twist()
        command.linear.x, command.angular.z = 1.0, 0.4

        def driven():
            cls.command.publish(command)
            return way_of(list(cls.truth.messages))[0] > WAY
        wait_for(driven, 'a way of 2 m')

    def test_odometry_starts_at_the_truth_and_drifts(self):
        truth = {m.header.stamp: m for m in self.truth.messages}
        odom = [m for m in self.odom.messages if m.header.stamp in truth]
        truth = [truth[m.header.stamp] for m in odom]
        self.assertEqual(pose_of(odom[0].pose.pose), pose_of(truth[0].pose.pose))
        (odom_way, odom_turn), (true_way, true_turn) = way_of(odom), way_of(truth)
        # Chords of a slow machine are shorter than their arcs.
        self.assertAlmostEqual(odom_way / true_way, 1.02, delta=2e-3)
        self.assertAlmostEqual(odom_turn / true_turn, 1.03, delta=1e-6)
        (ox, oy, _), (tx, ty, _) = pose_of(odom[-1].pose.pose), pose_of(truth[-1].pose.pose)
        self.assertGreater(math.hypot(ox - tx, oy - ty), 0.02)

    def test_the_world_lies_below_the_robot_where_it_truly_is(self):
        truth = {m.header.stamp: pose_of(m.pose.pose) for m in self.truth.messages}
        worlds = [t for m in self.frames.messages for t in m.transforms
                  if t.child_frame_id == 'world' and t.header.stamp in truth]
        self.assertGreater(len(worlds), 20)
        for world in worlds:
            self.assertEqual(world.header.frame_id, 'base_link')
            x, y, yaw = truth[world.header.stamp]
            wx, wy, wyaw = pose_of(world.transform)
            self.assertAlmostEqual(wyaw, -yaw, delta=1e-9)
            self.assertAlmostEqual(x + wx * math.cos(yaw) - wy * math.sin(yaw), 0.0, delta=1e-9)
            self.assertAlmostEqual(y + wx * math.sin(yaw) + wy * math.cos(yaw), 0.0, delta=1e-9)

    def test_the_ground_truth_that_is_missing_is_a_warning(self):
        def reported(name):
            return self.diagnostics.wait(
                lambda all: [s for m in all for s in m.status if s.name == name], name)[-1]
        missing = reported('no_ground_truth: frame nowhere')
        self.assertEqual(missing.level, DiagnosticStatus.WARN)
        self.assertIn('/nobody/publishes', missing.message)
        found = reported('ground_truth: frame world')
        self.assertEqual((found.level, found.message), (DiagnosticStatus.OK, 'running'))

    def test_a_pose_that_is_none_is_a_warning(self):
        poses = publisher('/bad_truth', Odometry)

        def expect(text, x, w):
            def publish():
                message = Odometry()
                message.header.stamp = rospy.Time.now()
                message.pose.pose.position.x, message.pose.pose.orientation.w = x, w
                poses.publish(message)
            self.diagnostics.wait(
                lambda all: [s for m in all for s in m.status
                             if s.name == 'bad_ground_truth: frame elsewhere' and s.message == text],
                text, publish)
        expect('/bad_truth: pose.position = (nan, 0, 0) is not finite', math.nan, 1.0)
        expect('/bad_truth: pose.orientation has the squared norm 0, allowed is 0.99 to 1.01', 1.0, 0.0)
        expect('running', 1.0, 1.0)

    def test_the_drag_of_the_grass_slows_it(self):
        def speed():
            return self.truth.messages[-1].twist.twist.linear.x
        drag, command = WrenchStamped(), Twist()
        drag.header.frame_id, drag.wrench.force.x = 'left_wheel_contact', -60.0
        command.linear.x = 1.0

        def fast():
            self.command.publish(command)
            return speed() > 0.9
        wait_for(fast, 'a robot that drives')
        before = speed()

        def slower():
            self.command.publish(command)
            self.wrench.publish(drag)
            return speed() < before - 0.1
        wait_for(slower, 'a slower robot')


if __name__ == '__main__':
    rospy.init_node('demo_robot_test')
    rostest.rosrun('vegetation_sim', 'demo_robot', DemoRobot)
