#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Repeats a list of driving commands on cmd_vel, in place of a driver or a planner.

The parameter ~legs is a list of forward speed [m/s], turning speed [rad/s] and duration [s].
"""
import rospy
from geometry_msgs.msg import Twist

RATE = 20.0  # [Hz]
# The default path is a stretched figure of eight, so that tracks lie beside and across each other.
LEGS = [[1.4, 0.0, 3.0], [1.2, 0.55, 6.0], [1.4, 0.0, 3.0], [1.2, -0.55, 6.5], [1.5, 0.08, 4.0]]


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
    legs = rospy.get_param('~legs', LEGS)
    commands = rospy.Publisher('cmd_vel', Twist, queue_size=10)
    start = rospy.Time.now()
    rate = rospy.Rate(RATE)
    while not rospy.is_shutdown():
        start = min(start, rospy.Time.now())  # The clock may jump back.
        command = Twist()
        command.linear.x, command.angular.z = leg_at(legs, (rospy.Time.now() - start).to_sec())
        commands.publish(command)
        try:
            rate.sleep()
        except rospy.ROSTimeMovedBackwardsException:
            rate = rospy.Rate(RATE)
        except rospy.ROSInterruptException:
            return


if __name__ == '__main__':
    main()
