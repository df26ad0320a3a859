#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A body drives into the plants of a scenario: the force on it over time, a lidar and a camera that
see plants bent and upright again, and a replay with the same hashes.

usage: push_field_test.py hedge | maize
"""
import math
import sys
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import Image, PointCloud2
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import PlantContacts, ScanReport

from canopy_rig import ReplayedLeaves
from crowd_rig import Cart
from forest_rig import RATE, time_of
from replaying import compare_replay
from scan_rig import cloud_of
from waiting import wait_for
from watched_node import Log

BEGIN = 1000 * RATE
SPEED = 0.8  # [m/s]
MAST = 0.9  # height of the sensors [m]


class Field:
    """Where a body begins and how far it drives [m], and the range of its largest force [N]."""

    def __init__(self, start, yaw, way, forces):
        self.start, self.yaw, self.way, self.forces = start, yaw, way, forces

    def place(self, along):
        """Returns the place at a distance from the start."""
        return (self.start[0] + along * math.cos(self.yaw), self.start[1] + along * math.sin(self.yaw))


# The hedge is across the way, and so are the rows of maize.
FIELDS = {'hedge': Field((-3.2, 0.0), 0.0, 1.7, (150.0, 600.0)),
          'maize': Field((0.0, -9.6), math.pi / 2, 2.6, (150.0, 1200.0))}
LEAFY = (ScanReport.FOLIAGE, ScanReport.STEM)


class PushField(ReplayedLeaves, unittest.TestCase):
    field = FIELDS[sys.argv[1]]

    def setUp(self):
        self.contacts = Log('/canopy/contacts', PlantContacts)
        self.points = Log('/lidar/points', PointCloud2)
        self.depths = Log('/camera/depth/image_raw', Image)
        self.labels = Log('/camera/label', Image)
        self.sensors = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        self.sensors.publish(TFMessage(self.frames()))
        self.begin(BEGIN)
        for log in (self.points, self.depths, self.labels):
            wait_for(log.connected, log.topic)
        self.cart = Cart(self.leaves)

    def frames(self):
        """Returns the frames of the sensors behind the start of the body."""
        x, y = self.field.place(-1.0)
        out = []
        half = 0.5 * self.field.yaw
        for parent, child, place, turn in (
                ('map', 'lidar', (x, y, MAST), (0.0, 0.0, math.sin(half), math.cos(half))),
                ('lidar', 'eye', (0.0, 0.0, 0.0), (-0.5, 0.5, -0.5, 0.5))):
            frame = TransformStamped(child_frame_id=child)
            frame.header.frame_id = parent
            frame.transform.translation = Vector3(*place)
            frame.transform.rotation = Quaternion(*turn)
            out.append(frame)
        return out

    def look(self):
        """Returns the distances, along the way, of leaves and stems before the body: the points of a
        lidar, and the pixels of a camera with their places in the image."""
        start = time_of(self.clock.tick)
        self.run_ticks(RATE + 1)
        cloud, depth, label = (
            log.wait(lambda all: next((m for m in all if m.header.stamp > start), None), log.topic,
                     lambda: self.clock.show(self.clock.tick))
            for log in (self.points, self.depths, self.labels))
        points = cloud_of(cloud)
        lane = points[numpy.isin(points['label'], LEAFY) & (abs(points['y']) < 0.25) &
                      (abs(points['z'] + 0.35) < 0.25)]
        depth = numpy.frombuffer(depth.data, 'f4').reshape(depth.height, depth.width)
        label = numpy.frombuffer(label.data, 'u2').reshape(label.height, label.width)
        return lane['x'], numpy.where(numpy.isin(label, LEAFY), depth, numpy.inf)

    def drive(self):
        """Drives the body, with a pose at each tick."""
        for i in range(int(self.field.way / SPEED * RATE)):
            self.put(SPEED * i / RATE)
            self.run_ticks(1)

    def put(self, along):
        self.cart.put(*self.field.place(along), time_of(self.clock.tick + 1), self.field.yaw)

    def hold_and_look(self):
        """Looks while the body stands at the end of its way."""
        run = self.run_ticks

        def run_with_body(count):
            for _ in range(count):
                self.put(self.field.way)
                run(1)
        self.run_ticks = run_with_body
        try:
            return self.look()
        finally:
            self.run_ticks = run

    def test_plants_bend_are_seen_and_stand_up(self):
        upright, picture = self.look()
        self.assertGreater(len(upright), 50)
        self.assertGreater(numpy.isfinite(picture).sum(), 300)
        self.drive()
        bent, picture_bent = self.hold_and_look()
        self.expect_force()
        self.run_ticks(10 * RATE)
        again, picture_again = self.look()
        rospy.loginfo('lidar: mean %.3f, %.3f, %.3f m', upright.mean(), bent.mean(), again.mean())
        self.assertGreater(bent.mean() - upright.mean(), 0.1)
        self.assertLess(abs(again.mean() - upright.mean()), 0.02)
        differ = [self.share_of_difference(picture, other) for other in (picture_bent, picture_again)]
        rospy.loginfo('camera: %.3f, %.3f of the pixels differ', *differ)
        self.assertGreater(differ[0], 0.1)
        self.assertLess(differ[1], 0.2 * differ[0])
        states, different = compare_replay(self, lambda: (self.leaves.hashes(), self.again.hashes()))
        self.assertGreater(states, 4)
        self.assertEqual(different, [])

    def share_of_difference(self, picture, other):
        """Returns the share of pixels whose plants are at other distances, or in one image only."""
        return numpy.mean(~numpy.isclose(picture, other, rtol=0.0, atol=0.05))

    def expect_force(self):
        """The plants push the body back, the more of them it touches."""
        ahead = math.cos(self.field.yaw), math.sin(self.field.yaw)
        forces = [-sum(c.force.x * ahead[0] + c.force.y * ahead[1] for c in message.contacts)
                  for message in self.contacts.messages]
        rospy.loginfo('force: %s N', [round(force) for force in forces[::5]])
        self.assertGreater(len(forces), RATE)
        self.assertLess(forces[0], 0.5 * max(forces))
        low, high = self.field.forces
        self.assertGreater(max(forces), low)
        self.assertLess(max(forces), high)


if __name__ == '__main__':
    rospy.init_node('push_field_test')
    rostest.rosrun('vegetation_sim', 'push_' + sys.argv[1], PushField)
