#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes the true world as a tf frame from a simulator's topic of the true pose of a robot.

A frame of tf has one parent, and that of the robot is its odometry (REP 105). Therefore the world
is a child of the robot, by the inverse of the pose. Every frame of the robot then has its true pose
in the world, while map and odom keep their estimates. The frame names of the messages are ignored,
since simulators disagree on them.
"""
import math
import re
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

LONGEST_SILENCE = 2.0  # [s]
LOGGED_AFTER = 5  # [s]


def rotated(q, v):
    """Returns the vector v rotated by the unit quaternion q."""
    axis = q.x, q.y, q.z

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    once = [2.0 * c for c in cross(axis, v)]
    twice = cross(axis, once)
    return [a + q.w * b + c for a, b, c in zip(v, once, twice)]


def inverse_of(pose):
    """Returns the translation and the rotation of the inverse of a pose."""
    q = pose.orientation
    square = q.x ** 2 + q.y ** 2 + q.z ** 2 + q.w ** 2
    if not 0.99 < square < 1.01:
        raise ValueError('pose.orientation has the squared norm %g, allowed is 0.99 to 1.01' % square)
    q = type(q)(-q.x, -q.y, -q.z, q.w)
    at = pose.position
    if not all(map(math.isfinite, (at.x, at.y, at.z))):
        raise ValueError('pose.position = (%g, %g, %g) is not finite' % (at.x, at.y, at.z))
    return [-c for c in rotated(q, (at.x, at.y, at.z))], q


class GroundTruthFrame:
    def __init__(self):
        self.world = rospy.get_param('~world_frame')
        self.base = rospy.get_param('~base_frame')
        self.stamp = None
        self.rejected = ''  # what is wrong with the newest pose
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.diagnostics = rospy.Publisher('/diagnostics', DiagnosticArray, queue_size=10)
        rospy.Subscriber('ground_truth', Odometry, self.on_pose, queue_size=10, tcp_nodelay=True)
        threading.Thread(target=self.report, daemon=True).start()

    def find_fault(self):
        """Returns what is missing or wrong, or an empty text."""
        topic = rospy.resolve_name('ground_truth')
        stamp = self.stamp
        if self.rejected:
            return '%s: %s' % (topic, self.rejected)
        if stamp is None:
            return 'no odometry on %s: there is no frame %s yet' % (topic, self.world)
        silence = (rospy.Time.now() - stamp).to_sec()
        if silence > LONGEST_SILENCE:
            return 'no odometry on %s for %.0f s' % (topic, silence)
        return ''

    def report(self):
        """Reports each second of wall time on /diagnostics, and once in the log what lasts."""
        kind, seconds = '', 0
        while True:
            time.sleep(1.0)
            if rospy.core.is_shutdown_requested():
                return
            fault = self.find_fault()
            before, kind = kind, re.sub(r'[-+.\d]+', '', fault)  # without its numbers
            seconds = seconds + 1 if kind == before else 0
            if fault and seconds == LOGGED_AFTER:
                rospy.logwarn(fault)
            status = DiagnosticStatus(name=rospy.get_name()[1:] + ': frame ' + self.world,
                                      hardware_id='none', message=fault or 'running',
                                      level=DiagnosticStatus.WARN if fault else DiagnosticStatus.OK)
            out = DiagnosticArray(status=[status])
            out.header.stamp = rospy.Time.now()
            self.diagnostics.publish(out)

    def on_pose(self, message):
        if message.header.stamp == self.stamp:
            return  # tf warns of repeated stamps.
        frame = TransformStamped(child_frame_id=self.world)
        frame.header.frame_id, frame.header.stamp = self.base, message.header.stamp
        try:
            place, frame.transform.rotation = inverse_of(message.pose.pose)
        except ValueError as error:
            self.rejected = str(error)
            return
        self.rejected = ''
        at = frame.transform.translation
        at.x, at.y, at.z = place
        self.stamp = message.header.stamp
        self.tf.publish(TFMessage([frame]))


if __name__ == '__main__':
    rospy.init_node('ground_truth_frame')
    frame = GroundTruthFrame()
    rospy.spin()
