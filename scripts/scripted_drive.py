#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives a robot by cmd_vel, in place of a driver or a planner.

Repeats the list ~legs of forward speed [m/s], turning speed [rad/s] and duration [s]; or visits the
list ~places of (x, y) in the world [m] in turn, by the topic base_pose_ground_truth.
"""
import math

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

RATE = 20.0  # [Hz]
# The default path is a stretched figure of eight, so that tracks lie beside and across each other.
LEGS = [[1.4, 0.0, 3.0], [1.2, 0.55, 6.0], [1.4, 0.0, 3.0], [1.2, -0.55, 6.5], [1.5, 0.08, 4.0]]

ARRIVED = 1.0  # distance at which a place has been reached [m]
SPEED, MOST_TURN, TURN_GAIN = 1.2, 0.8, 1.5  # towards a place [m/s], [rad/s], [1/s]


class PlacesDriver:
    """Drives to places in turn, and begins again after the last."""

    def __init__(self, places):
        self.places, self.next, self.pose = places, 0, None
        rospy.Subscriber('base_pose_ground_truth', Odometry, self.on_pose, tcp_nodelay=True)

    def on_pose(self, odometry):
        self.pose = odometry.pose.pose

    def command(self):
        """Returns forward speed [m/s] and turning speed [rad/s]."""
        if not self.pose:
            return 0.0, 0.0
        at, q = self.pose.position, self.pose.orientation
        x, y = (to - here for to, here in zip(self.places[self.next], (at.x, at.y)))
        if math.hypot(x, y) < ARRIVED:
            self.next = (self.next + 1) % len(self.places)
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        aside = math.remainder(math.atan2(y, x) - yaw, 2.0 * math.pi)
        return (SPEED * max(0.2, math.cos(aside)),
                max(-MOST_TURN, min(MOST_TURN, TURN_GAIN * aside)))


def leg_at(legs, seconds):
    """Returns the leg that is active `seconds` after the start."""
    left = seconds % sum(duration for _, _, duration in legs)
    for speed, turn, duration in legs:
        if left < duration:
            return speed, turn
        left -= duration
    return 0.0, 0.0


def main():
    rospy.init_node('scripted_drive')
    legs, places = rospy.get_param('~legs', LEGS), rospy.get_param('~places', [])
    driver = PlacesDriver(places) if places else None
    commands = rospy.Publisher('cmd_vel', Twist, queue_size=10)
    start = rospy.Time.now()
    rate = rospy.Rate(RATE)
    while not rospy.is_shutdown():
        start = min(start, rospy.Time.now())  # The clock may jump back.
        command = Twist()
        command.linear.x, command.angular.z = (
            driver.command() if driver else leg_at(legs, (rospy.Time.now() - start).to_sec()))
        commands.publish(command)
        try:
            rate.sleep()
        except rospy.ROSTimeMovedBackwardsException:
            rate = rospy.Rate(RATE)
        except rospy.ROSInterruptException:
            return


if __name__ == '__main__':
    main()
