#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A differential-drive robot on flat ground, as simple as can be: cmd_vel in; odometry and the frames of
its URDF (parameter robot_description) out. Grass that resists its wheels (grass/wrenches) slows it."""
import math
import xml.etree.ElementTree

import rospy
from geometry_msgs.msg import TransformStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

RATE = 50.0  # [Hz]
LAG = 0.25  # of the motors [s]
SILENCE = 0.5  # a command holds for this long [s]
MASS = 60.0  # [kg]


def turned(x, y, yaw):
    return math.cos(yaw) * x - math.sin(yaw) * y, math.sin(yaw) * x + math.cos(yaw) * y


def joints_of(urdf):
    """Parent, child and place of every joint."""
    out = []
    for joint in xml.etree.ElementTree.fromstring(urdf).iter('joint'):
        place = [float(number) for number in joint.find('origin').get('xyz').split()]
        out.append((joint.find('parent').get('link'), joint.find('child').get('link'), place))
    return out


class DiffDriveRobot:
    def __init__(self):
        self.joints = joints_of(rospy.get_param('robot_description'))
        self.world = rospy.get_param('~frame_id', 'map')
        self.x, self.y = rospy.get_param('~x', 0.0), rospy.get_param('~y', 0.0)
        self.yaw = rospy.get_param('~yaw', 0.0)
        self.speed, self.spin, self.rolled = 0.0, 0.0, {'left_wheel': 0.0, 'right_wheel': 0.0}
        self.command, self.commanded, self.drag = Twist(), None, {}
        self.last = None
        self.odom = rospy.Publisher('odom', Odometry, queue_size=10)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        rospy.Subscriber('cmd_vel', Twist, self.obey)
        rospy.Subscriber('grass/wrenches', WrenchStamped, self.feel)

    def obey(self, command):
        self.command, self.commanded = command, rospy.Time.now()

    def feel(self, wrench):
        self.drag[wrench.header.frame_id] = wrench.wrench.force.x

    def step(self, now):
        dt = (now - self.last).to_sec() if self.last else 0.0
        self.last = now
        if not 0.0 < dt < 1.0:  # the first step, or time jumped
            return
        heard = self.commanded and 0.0 <= (now - self.commanded).to_sec() < SILENCE
        speed, spin = (self.command.linear.x, self.command.angular.z) if heard else (0.0, 0.0)
        lag = 1.0 - math.exp(-dt / LAG)
        self.speed += lag * (speed - self.speed) + dt * sum(self.drag.values()) / MASS
        self.spin += lag * (spin - self.spin)
        middle = self.yaw + 0.5 * dt * self.spin
        self.x += dt * self.speed * math.cos(middle)
        self.y += dt * self.speed * math.sin(middle)
        self.yaw += dt * self.spin
        for wheel, side in (('left_wheel', -1.0), ('right_wheel', 1.0)):
            self.rolled[wheel] += dt * (self.speed + side * 0.28 * self.spin) / 0.18

    def tell(self, now):
        odom = Odometry(child_frame_id='base_link')
        odom.header.stamp, odom.header.frame_id = now, self.world
        pose = odom.pose.pose
        pose.position.x, pose.position.y = self.x, self.y
        pose.orientation.w, pose.orientation.z = math.cos(0.5 * self.yaw), math.sin(0.5 * self.yaw)
        odom.twist.twist.linear.x, odom.twist.twist.angular.z = self.speed, self.spin
        self.odom.publish(odom)
        frames = [self.frame(now, self.world, 'base_link', (self.x, self.y, 0.0), pose.orientation)]
        frames += [self.joint(now, *joint) for joint in self.joints]
        self.tf.publish(TFMessage(frames))

    def joint(self, now, parent, child, place):
        out = self.frame(now, parent, child, place)
        angle = self.rolled.get(child, 0.0)
        out.transform.rotation.w, out.transform.rotation.y = math.cos(0.5 * angle), math.sin(0.5 * angle)
        return out

    @staticmethod
    def frame(now, parent, child, place, rotation=None):
        out = TransformStamped(child_frame_id=child)
        out.header.stamp, out.header.frame_id = now, parent
        at = out.transform.translation
        at.x, at.y, at.z = place
        out.transform.rotation.w = 1.0
        if rotation:
            out.transform.rotation = rotation
        return out

    def run(self):
        rate = rospy.Rate(RATE)
        while not rospy.is_shutdown():
            now = rospy.Time.now()
            if now != self.last:
                self.step(now)
                self.tell(now)
            try:
                rate.sleep()
            except rospy.ROSTimeMovedBackwardsException:
                rate = rospy.Rate(RATE)
            except rospy.ROSInterruptException:
                return


if __name__ == '__main__':
    rospy.init_node('diff_drive_robot')
    DiffDriveRobot().run()
