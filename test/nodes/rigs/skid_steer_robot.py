#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A robot simulator that knows nothing of this package: a skid-steer vehicle with a mast.

Its frames are map -> odom -> base_footprint -> links (REP 105), each with the prefix of the robot.
Its localiser is wrong by a metre and a half, so map -> base_footprint is not the true pose, which
is on the topic truth, as simulators publish it. As a program it drives a circle in real time.
"""
import math
import xml.etree.ElementTree

import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

WHEEL_RADIUS = 0.15  # [m]
LOCALISER_ERROR = 1.5, -0.4, 0.1  # map -> odom; x, y [m] and yaw [rad]


def transform(stamp, parent, child, xyz, axis=(0.0, 0.0, 1.0), angle=0.0):
    out = TransformStamped(child_frame_id=child)
    out.header.frame_id, out.header.stamp = parent, stamp
    move, turn = out.transform.translation, out.transform.rotation
    move.x, move.y, move.z = xyz
    turn.x, turn.y, turn.z = (math.sin(0.5 * angle) * part for part in axis)
    turn.w = math.cos(0.5 * angle)
    return out


class SkidSteerRobot:
    def __init__(self, prefix, urdf, x, y, yaw, tf=None):
        self.prefix, self.x, self.y, self.yaw = prefix, x, y, yaw
        self.driven, self.way = (0.0, 0.0, 0.0), 0.0
        self.joints = [(joint.find('parent').get('link'), joint.find('child').get('link'),
                        tuple(map(float, joint.find('origin').get('xyz').split())))
                       for joint in xml.etree.ElementTree.fromstring(urdf).iter('joint')]
        self.tf = tf or rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.truth = rospy.Publisher(prefix + 'truth', Odometry, queue_size=10, tcp_nodelay=True)

    def drive(self, speed, spin, seconds):
        """Moves truth and odometry; the wheels do not slip."""
        self.x, self.y, self.yaw = self.moved((self.x, self.y, self.yaw), speed, spin, seconds)
        self.driven = self.moved(self.driven, speed, spin, seconds)
        self.way += speed * seconds

    @staticmethod
    def moved(pose, speed, spin, seconds):
        x, y, yaw = pose
        middle = yaw + 0.5 * seconds * spin
        return (x + seconds * speed * math.cos(middle), y + seconds * speed * math.sin(middle),
                yaw + seconds * spin)

    def publish(self, stamp):
        p, (ex, ey, eyaw), (ox, oy, oyaw) = self.prefix, LOCALISER_ERROR, self.driven
        frames = [transform(stamp, p + 'map', p + 'odom', (ex, ey, 0.0), angle=eyaw),
                  transform(stamp, p + 'odom', p + 'base_footprint', (ox, oy, 0.0), angle=oyaw)]
        for parent, child, xyz in self.joints:
            angle = self.way / WHEEL_RADIUS if child.startswith('wheel') else 0.0
            frames.append(transform(stamp, p + parent, p + child, xyz, (0.0, 1.0, 0.0), angle))
        self.tf.publish(TFMessage(frames))
        truth = Odometry(child_frame_id='ground_truth_link')
        truth.header.stamp, truth.header.frame_id = stamp, 'simulator'
        pose = truth.pose.pose
        pose.position.x, pose.position.y = self.x, self.y
        pose.orientation.z, pose.orientation.w = math.sin(0.5 * self.yaw), math.cos(0.5 * self.yaw)
        self.truth.publish(truth)


def main():
    rospy.init_node('skid_steer_robot')
    robot = SkidSteerRobot(rospy.get_param('~prefix', ''), rospy.get_param('robot_description'),
                           *(rospy.get_param('~' + name, 0.0) for name in ('x', 'y', 'yaw')))
    rate = rospy.Rate(50)
    while not rospy.is_shutdown():
        robot.drive(rospy.get_param('~speed', 0.6), rospy.get_param('~spin', 0.1), 0.02)
        robot.publish(rospy.Time.now())
        rate.sleep()


if __name__ == '__main__':
    try:
        main()
    except rospy.ROSInterruptException:
        pass
