#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Simulates a differential-drive robot with a minimal model.

Subscribes to cmd_vel; publishes odometry and the frames of the URDF in the parameter
robot_description. The drag of the grass on the wheels (grass/wrenches) slows the robot, and so do
trunks, branches and plants (forest/forces, canopy/contacts): against a trunk it stands still. It
stands on the ground of the meadow, and slopes slow or accelerate it; without a command, brakes hold
it.

The frames follow REP 105: odom -> base_link is where the robot believes that it is, from wheels
that it takes for a little larger and closer together than they are, so it drifts, and takes the
ground for flat. The true pose is on the topic base_pose_ground_truth; ground_truth_frame.py makes
the frame world of it, in which odom is seen to move.
"""
import math
import xml.etree.ElementTree

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage
from vegetation_sim import Ground
from vegetation_sim.msg import ContactForces, PlantContacts

RATE = 50.0  # [Hz]
MOTOR_TIME_CONSTANT = 0.25  # Time constant of the motors. [s]
COMMAND_TIMEOUT = 0.5  # A command expires after this time. [s]
MASS = 60.0  # [kg]
GRAVITY = 9.81  # [m/s^2]
# Odometry over truth.
WAY_ERROR, TURN_ERROR = 1.02, 1.03


class PlanarPose:
    def __init__(self, x, y, yaw):
        self.x, self.y, self.yaw = x, y, yaw

    def move(self, way, turn):
        middle = self.yaw + 0.5 * turn
        self.x += way * math.cos(middle)
        self.y += way * math.sin(middle)
        self.yaw += turn


def joints_of(urdf):
    """Returns parent, child, position and rotation of every joint."""
    out = []
    for joint in xml.etree.ElementTree.fromstring(urdf).iter('joint'):
        origin = joint.find('origin')
        place, angles = ([float(number) for number in origin.get(key, '0 0 0').split()]
                         for key in ('xyz', 'rpy'))
        out.append((joint.find('parent').get('link'), joint.find('child').get('link'), place,
                    rotation_of(*angles)))
    return out


def rotation_of(roll, pitch, yaw):
    """Returns the rotation by roll, then pitch, then yaw about fixed axes."""
    (a, b, c), (d, e, f) = ([g(0.5 * angle) for angle in (roll, pitch, yaw)]
                            for g in (math.cos, math.sin))
    return Quaternion(d * b * c - a * e * f, a * e * c + d * b * f, a * b * f - d * e * c,
                      a * b * c + d * e * f)


def rotation_on(up, yaw):
    """Returns the rotation by yaw about the vertical, then by the least angle that turns the vertical
    to the unit vector `up`."""
    tilt = math.sqrt(0.5 * (1.0 + up[2]))  # cosine of half the angle
    x, y = -0.5 * up[1] / tilt, 0.5 * up[0] / tilt
    s, c = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    return Quaternion(x * c + y * s, y * c - x * s, tilt * s, tilt * c)


def slow_down(speed, change):
    """Returns the speed after a change against it. The forces of contacts are as old as their tick,
    so they stop the robot but never accelerate it."""
    if speed * change >= 0.0:
        return speed
    return math.copysign(max(0.0, abs(speed) - abs(change)), speed)


class DiffDriveRobot:
    def __init__(self):
        self.joints = joints_of(rospy.get_param('robot_description'))
        start = [rospy.get_param('~' + name, 0.0) for name in ('x', 'y', 'yaw')]
        # The estimate begins at the truth, so that all of its error is drift.
        self.truth, self.estimate = PlanarPose(*start), PlanarPose(*start)
        self.ground = Ground()
        self.height, self.up = self.ground.at(self.truth.x, self.truth.y)
        self.speed, self.spin, self.rolled = 0.0, 0.0, {'left_wheel': 0.0, 'right_wheel': 0.0}
        self.links = {'base_link'} | {child for _, child, _, _ in self.joints}
        self.command, self.commanded, self.drag, self.contacts = Twist(), None, {}, {}
        self.last = None
        self.odom = rospy.Publisher('odom', Odometry, queue_size=10)
        self.ground_truth = rospy.Publisher('base_pose_ground_truth', Odometry, queue_size=10)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        rospy.Subscriber('cmd_vel', Twist, self.on_command)
        rospy.Subscriber('grass/wrenches', WrenchStamped, self.on_wrench)
        rospy.Subscriber('forest/forces', ContactForces,
                         lambda message: self.on_contacts('forest', message.forces))
        rospy.Subscriber('canopy/contacts', PlantContacts,
                         lambda message: self.on_contacts('canopy', message.contacts))

    def on_command(self, command):
        self.command, self.commanded = command, rospy.Time.now()

    def on_wrench(self, wrench):
        self.drag[wrench.header.frame_id] = wrench.wrench.force.x

    def on_contacts(self, source, contacts):
        self.contacts[source] = [contact.force for contact in contacts
                                 if contact.frame in self.links]

    def contact_force(self):
        """Returns the force of all touched branches and plants along the robot's x axis [N]."""
        forward = math.cos(self.truth.yaw), math.sin(self.truth.yaw)
        return sum(forward[0] * force.x + forward[1] * force.y
                   for forces in list(self.contacts.values()) for force in forces)

    def slope(self):
        """Returns the sine of the angle by which the robot's x axis rises."""
        ahead = math.cos(self.truth.yaw), math.sin(self.truth.yaw)
        rise = -(self.up[0] * ahead[0] + self.up[1] * ahead[1]) / self.up[2]
        return rise / math.hypot(1.0, rise)

    def step(self, now):
        dt = (now - self.last).to_sec() if self.last else 0.0
        self.last = now
        if not 0.0 < dt < 1.0:  # This is the first step, or the clock jumped.
            return
        active = self.commanded and 0.0 <= (now - self.commanded).to_sec() < COMMAND_TIMEOUT
        speed, spin = (self.command.linear.x, self.command.angular.z) if active else (0.0, 0.0)
        slope = self.slope()
        load = sum(self.drag.values()) / MASS
        if speed != 0.0 or spin != 0.0:
            load -= GRAVITY * slope
        response = 1.0 - math.exp(-dt / MOTOR_TIME_CONSTANT)
        self.speed += response * (speed + MOTOR_TIME_CONSTANT * load - self.speed)
        self.speed = slow_down(self.speed, dt * self.contact_force() / MASS)
        self.spin += response * (spin - self.spin)
        self.truth.move(dt * self.speed * math.sqrt(1.0 - slope * slope), dt * self.spin)
        self.height, self.up = self.ground.at(self.truth.x, self.truth.y)
        self.estimate.move(WAY_ERROR * dt * self.speed, TURN_ERROR * dt * self.spin)
        for wheel, side in (('left_wheel', -1.0), ('right_wheel', 1.0)):
            self.rolled[wheel] += dt * (self.speed + side * 0.28 * self.spin) / 0.18

    def publish(self, now):
        at = self.estimate
        frames = [self.frame(now, 'odom', 'base_link', (at.x, at.y, 0.0), rotation_of(0.0, 0.0, at.yaw))]
        frames += [self.joint(now, *joint) for joint in self.joints]
        self.tf.publish(TFMessage(frames))
        self.odom.publish(self.odometry(now, 'odom', at, WAY_ERROR, TURN_ERROR))
        truth = self.odometry(now, 'world', self.truth, 1.0, 1.0)
        truth.pose.pose.position.z = self.height
        truth.pose.pose.orientation = rotation_on(self.up, self.truth.yaw)
        self.ground_truth.publish(truth)

    def odometry(self, now, frame, at, way_error, turn_error):
        out = Odometry(child_frame_id='base_link')
        out.header.stamp, out.header.frame_id = now, frame
        out.pose.pose.position.x, out.pose.pose.position.y = at.x, at.y
        out.pose.pose.orientation = rotation_of(0.0, 0.0, at.yaw)
        out.twist.twist.linear.x = way_error * self.speed
        out.twist.twist.angular.z = turn_error * self.spin
        return out

    def joint(self, now, parent, child, place, rotation):
        if child in self.rolled:
            rotation = rotation_of(0.0, self.rolled[child], 0.0)
        return self.frame(now, parent, child, place, rotation)

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
                self.publish(now)
            try:
                rate.sleep()
            except rospy.ROSTimeMovedBackwardsException:
                rate = rospy.Rate(RATE)
            except rospy.ROSInterruptException:
                return


if __name__ == '__main__':
    rospy.init_node('diff_drive_robot')
    DiffDriveRobot().run()
