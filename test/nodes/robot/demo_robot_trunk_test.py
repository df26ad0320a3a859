#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the robot of the demos against the trunk of an oak, which it does not pass."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from vegetation_sim.msg import ContactForces

from waiting import wait_for
from watched_node import Log, publisher

TRUNK = 2.0  # Axis of the trunk along the way. [m]
FRONT = 0.23  # Front of the chassis before base_link. [m]


class DemoRobotTrunk(unittest.TestCase):
    def test_a_trunk_stops_the_robot(self):
        truth, forces = (Log('/base_pose_ground_truth', Odometry),
                         Log('/forest/forces', ContactForces))
        commands, command = publisher('/cmd_vel', Twist), Twist()
        wait_for(lambda: truth.messages and forces.messages, 'robot and forest')
        command.linear.x = 1.0

        def touched():
            commands.publish(command)
            return any(f.branch == 0 and f.frame == 'chassis'
                       for message in list(forces.messages) for f in message.forces)
        wait_for(touched, 'the trunk touches the chassis')
        end = rospy.Time.now() + rospy.Duration(3.0)

        def pushed_for_a_while():
            commands.publish(command)
            return rospy.Time.now() > end
        wait_for(pushed_for_a_while, 'a robot that pushes the trunk')
        front = [m.pose.pose.position.x + FRONT for m in list(truth.messages)]
        self.assertLess(front[-1], TRUNK)
        # The motors go on, and the trunk yields by as much as their force bends and presses it.
        self.assertLess(front[-1] - front[-50], 0.02)
        self.assertLess(abs(truth.messages[-1].twist.twist.linear.x), 0.05)


if __name__ == '__main__':
    rospy.init_node('demo_robot_trunk_test')
    rostest.rosrun('vegetation_sim', 'demo_robot_trunk', DemoRobotTrunk)
