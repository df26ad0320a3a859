#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""One include of robot.launch connects a robot whose simulator knows nothing of this package: it
treads grass, pushes branches, is avoided by people, and its lidar sees them, all at its true pose
while its localiser is wrong. A second include connects a second robot, which
has a mesh."""
import math
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import CameraInfo, Image, LaserScan, PointCloud2
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ScanReport, WindSamples

from crowd_rig import Crowd
from forest_rig import RATE, Animator, TickClock, time_of
from grass_rig import Meadow
from scan_rig import cloud_of
from skid_steer_robot import SkidSteerRobot, transform
from waiting import wait_for
from watched_node import Log, publisher, wait_for_readers

SPEED = 1.0  # [m/s]
WOOD = ScanReport.TRUNK, ScanReport.BRANCH, ScanReport.LEAF
NODES = ('/forest_animator', '/grass_field', '/agent_crowd', '/vegetation_scanner', '/cart_scanner',
         '/vegetation_camera', '/cart_camera')


class RobotLaunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest, cls.grass, cls.crowd = Animator(), Meadow(), Crowd()
        cls.nodes = cls.forest, cls.grass, cls.crowd
        cls.clock = TickClock(1000 * RATE)
        cls.wrenches = Log('/forest/wrenches', WrenchStamped)
        cls.clouds = {name: Log(topic, PointCloud2) for name, topic in
                      (('scout', '/lidar/points'), ('cart', '/cart/lidar/points'))}
        cls.plane = Log('/cart/lidar/scan', LaserScan)
        cls.cameras = {name: (Log(topic + 'label', Image), Log(topic + 'depth/camera_info', CameraInfo))
                       for name, topic in (('scout', '/camera/'), ('cart', '/cart/camera/'))}
        cls.winds = Log('/wind/samples', WindSamples)
        cls.frames = Log('/tf', TFMessage)
        cls.tf = publisher('/tf', TFMessage)
        wait_for_readers('/tf', *NODES)
        cls.robot = SkidSteerRobot('scout/', rospy.get_param('scout/robot_description'), 0.0, -4.0,
                                   math.pi / 2, cls.tf)
        for log in (cls.wrenches, cls.winds, cls.plane, cls.frames, *cls.clouds.values(),
                    *cls.cameras['scout'], *cls.cameras['cart']):
            wait_for(log.connected, log.topic)
        wait_for_readers('/scout/truth', '/scout_ground_truth')
        cls.crowd.wait_until_up()
        cls.grass.wait_until_up('/wind')
        cls.clock.begin(cls.forest)
        cls.record = cls.drive_through()

    @classmethod
    def drive_through(cls):
        """Drives both robots 8 m along y. Returns pose, person and physical branches by tick."""
        out = []
        for _ in range(int(8.0 / SPEED * RATE)):
            stamp = time_of(cls.clock.tick + 1)
            cls.robot.drive(SPEED, 0.0, 1.0 / RATE)
            cls.tf.publish(TFMessage([
                transform(stamp, 'world', 'cart/base', (4.0, cls.robot.y, 0.0)),
                transform(stamp, 'cart/base', 'cart/laser', (0.0, 0.0, 1.0)),
                transform(stamp, 'cart/base', 'cart/eye', (0.0, 0.0, 1.2))]))
            cls.robot.publish(stamp)
            cls.frames.wait(lambda all: any(t.child_frame_id == 'world' and t.header.stamp == stamp
                                            for m in all for t in m.transforms), 'the world')
            del cls.frames.messages[:]
            cls.clock.run(1, *cls.nodes)
            person = next(iter(cls.crowd.agents().values())).pose.position
            physical = [i for tree in (0, 1) for i in cls.forest.tree(tree).physical]
            out.append((cls.robot.y, (person.x, person.y), physical))
        return out

    def test_wheels_tread_where_the_robot_is_and_not_where_it_believes_to_be(self):
        for x in (-0.35, 0.35):
            self.assertGreater(self.grass.at(x, -2.0).tilt, 1.2)
        self.assertLess(self.grass.at(0.0, -2.0).tilt, 0.3)
        self.assertEqual({s.tilt for s in self.grass.samples([(1.5, -2.0), (2.0, 0.0), (1.1, -1.0)])},
                         {0.0})

    def test_the_mast_pushes_branches_and_the_force_is_in_its_frame(self):
        self.assertTrue(any(physical for _, _, physical in self.record))
        forces = [w.wrench.force for w in self.wrenches.messages
                  if w.header.frame_id == 'scout/mast']
        self.assertGreater(len(forces), 10)
        back = sum(f.x for f in forces) / len(forces)
        aside = sum(f.y for f in forces) / len(forces)
        # The robot drives along its x axis, which is y of the world, and the branches push back.
        self.assertLess(back, -0.5)
        self.assertLess(abs(aside), abs(back))

    def test_the_mesh_of_a_second_robot_pushes_branches(self):
        forces = [w.wrench.force for w in self.wrenches.messages
                  if w.header.frame_id == 'cart/base']
        self.assertGreater(len(forces), 10)
        # The cart drives along y, and its frame has the axes of the world.
        self.assertLess(sum(f.y for f in forces) / len(forces), -0.5)
        self.assertEqual(self.forest.diagnostics()['Links of robots without a shape'], 0)

    def test_a_person_in_the_way_steps_aside(self):
        nearest = min(math.hypot(max(abs(x) - 0.4, 0.0), max(abs(y - robot) - 0.35, 0.0))
                      for robot, (x, y), _ in self.record)
        self.assertGreater(nearest, 0.15)  # radius of a person, less some ticks of latency

    def test_the_lidar_sees_branches_person_and_ground_from_the_true_pose(self):
        first = self.clouds['scout'].messages[5]
        self.assertEqual(first.header.frame_id, 'scout/velodyne')
        cloud = cloud_of(first)
        for label in (ScanReport.BRANCH, ScanReport.PERSON, ScanReport.GROUND, ScanReport.GRASS):
            self.assertGreater((cloud['label'] == label).sum(), 0, label)
        wood = cloud[numpy.isin(cloud['label'], WOOD) & (cloud['plant'] == 0)]
        ticks = (first.header.stamp - time_of(1000 * RATE)).to_sec() * RATE
        robot = min(self.record, key=lambda entry: abs(entry[0] - (-4.0 + SPEED / RATE * ticks)))[0]
        # The lidar is 0.3 m ahead of the robot's origin; the birch is within 0.5 m of its foot.
        self.assertAlmostEqual(numpy.median(wood['x']), -1.0 - robot - 0.3, delta=0.5)
        self.assertAlmostEqual(numpy.median(wood['y']), 0.5, delta=0.4)

    def test_the_wind_is_sampled_at_the_robot(self):
        samples = {sample.frame: sample for sample in self.winds.messages[-1].samples}
        self.assertEqual(set(samples), {'scout/base_footprint', 'cart/base'})
        for sample in samples.values():
            self.assertLess(abs(sample.position.y - self.robot.y), 0.5)

    def test_each_robot_has_a_camera_of_its_own(self):
        for robot, frame, width in ('scout', 'scout/velodyne', 32), ('cart', 'cart/eye', 48):
            for log in self.cameras[robot]:
                self.assertGreater(len(log.messages), 5, log.topic)
                self.assertEqual({m.header.frame_id for m in log.messages}, {frame})
                self.assertEqual({m.width for m in log.messages}, {width})

    def test_a_second_robot_treads_and_scans(self):
        self.assertGreater(self.grass.at(4.0, -2.0).tilt, 1.2)
        self.assertEqual(self.clouds['cart'].messages[-1].header.frame_id, 'cart/laser')
        self.assertEqual(self.plane.messages[-1].range_max, 100.0)  # of lidar_preset
        self.assertEqual(self.crowd.diagnostics()['Robots'], 2)


if __name__ == '__main__':
    rospy.init_node('robot_launch_test')
    rostest.rosrun('vegetation_sim', 'robot_launch', RobotLaunch)
