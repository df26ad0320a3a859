# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A robot that treads grass, pushes branches with its arm and crosses the way of people."""
import math

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from scene import NANOSECONDS
from watched_node import publisher

RATE = 30.0                 # messages per second of simulated time [Hz]
CENTRE, HALF = (-3.5, -0.5), (3.2, 3.8)  # of the ellipse on which it drives [m]
TURN = 40.0                 # duration of a round [s]
PARTS = {'arm': (0.5, 0.0, 1.8), 'lidar': (0.0, 0.0, 1.0)}  # places in base_link [m]


def _quaternion(yaw):
    return Quaternion(0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))


class Robot:
    """Publishes tf and odometry while it is not lost. While it parks, it waits where the next round
    begins, and there its arm touches nothing."""

    def __init__(self):
        self.lost = self.parks = False
        self._driven = 0.0  # duration of its drive [s]
        self._last = 0.0
        self._tf = publisher('/tf', TFMessage)
        self._odometry = publisher('/odom', Odometry)

    def publish(self, now):
        if self.lost or now - self._last < 1.0 / RATE:
            return
        self._drive(now - self._last if self._last else 0.0)
        self._last = now
        stamp = rospy.Time(0, int(now * NANOSECONDS))
        angle = 2.0 * math.pi * self._driven / TURN
        x, y = CENTRE[0] + HALF[0] * math.cos(angle), CENTRE[1] + HALF[1] * math.sin(angle)
        yaw = math.atan2(HALF[1] * math.cos(angle), -HALF[0] * math.sin(angle))
        frames = [self._frame('map', 'base_link', (x, y, 0.0), yaw, stamp)]
        frames += [self._frame('base_link', part, place, 0.0, stamp) for part, place in PARTS.items()]
        self._tf.publish(TFMessage(frames))
        self._publish_odometry(x, y, yaw, stamp)

    def _drive(self, duration):
        round_ends = TURN * math.ceil(self._driven / TURN)
        self._driven += duration
        if self.parks:
            self._driven = min(self._driven, round_ends)

    @staticmethod
    def _frame(parent, child, place, yaw, stamp):
        out = TransformStamped(child_frame_id=child)
        out.header.frame_id, out.header.stamp = parent, stamp
        out.transform.translation, out.transform.rotation = Vector3(*place), _quaternion(yaw)
        return out

    def _publish_odometry(self, x, y, yaw, stamp):
        out = Odometry(child_frame_id='base_link')
        out.header.frame_id, out.header.stamp = 'map', stamp
        out.pose.pose.position.x, out.pose.pose.position.y = x, y
        out.pose.pose.orientation = _quaternion(yaw)
        self._odometry.publish(out)
