#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Moves the rolling stone of paper 2, figure 4, on a closed curve over flat ground.

Broadcasts the frame of the stone and publishes its marker. grass_field treads the grass under the
frame.
"""
import math

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

RATE = 50.0  # [Hz]
RADIUS = 0.45  # [m]
WIDE, DEEP, PERIOD = 9.0, 5.0, 40.0  # Half axes of the curve [m] and time of one round [s].
SIZES = (1.0, 0.88, 0.94)  # Diameters of the stone along its axes, relative to 2 RADIUS.


def place(seconds):
    angle = 2.0 * math.pi * seconds / PERIOD
    return WIDE * math.sin(angle), DEEP * math.sin(2.0 * angle)


def product(a, b):
    """Returns the product of two quaternions (x y z w)."""
    return (a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2])


class RollingStone:
    def __init__(self):
        self.world = rospy.get_param('~frame_id', 'map')
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.markers = rospy.Publisher('stone/markers', MarkerArray, queue_size=1)
        self.at, self.turn = None, (0.0, 0.0, 0.0, 1.0)

    def roll(self, now):
        x, y = place(now.to_sec() % PERIOD)
        if self.at:
            dx, dy = x - self.at[0], y - self.at[1]
            way = math.hypot(dx, dy)
            if 0.0 < way < 1.0:
                half = 0.5 * way / RADIUS
                self.turn = product((-dy / way * math.sin(half), dx / way * math.sin(half), 0.0,
                                     math.cos(half)), self.turn)
        self.at = (x, y)

    def publish(self, now):
        out = TransformStamped(child_frame_id='stone')
        out.header.stamp, out.header.frame_id = now, self.world
        out.transform.translation.x, out.transform.translation.y = self.at
        out.transform.translation.z = RADIUS
        turn = out.transform.rotation
        turn.x, turn.y, turn.z, turn.w = self.turn
        self.tf.publish(TFMessage([out]))
        marker = Marker(ns='stone', type=Marker.SPHERE)
        marker.header.frame_id = self.world
        marker.pose.position.x, marker.pose.position.y, marker.pose.position.z = *self.at, RADIUS
        marker.pose.orientation = turn
        marker.scale.x, marker.scale.y, marker.scale.z = (2.0 * RADIUS * size for size in SIZES)
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = 0.46, 0.44, 0.41, 1.0
        self.markers.publish(MarkerArray([marker]))

    def run(self):
        rate = rospy.Rate(RATE)
        while not rospy.is_shutdown():
            now = rospy.Time.now()
            self.roll(now)
            self.publish(now)
            try:
                rate.sleep()
            except rospy.ROSTimeMovedBackwardsException:
                rate = rospy.Rate(RATE)
            except rospy.ROSInterruptException:
                return


if __name__ == '__main__':
    rospy.init_node('rolling_stone')
    RollingStone().run()
