#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the scenarios of fields of the demo without rviz: a lidar between the rows sees the parts of
their plants, each with its label and the id of its plant."""
import contextlib
import math
import signal
import subprocess
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import TransformStamped, Vector3
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import CanopyLayout, CanopyState, ScanReport

from scan_rig import cloud_of
from waiting import DEADLINE
from watched_node import Log

GROUND, GRASS = ScanReport.GROUND, ScanReport.GRASS
TREES = {ScanReport.TRUNK, ScanReport.BRANCH, ScanReport.LEAF}


class FieldScenarios(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mast = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)

    def cloud_from(self, scenario, place, labels):
        """Returns a cloud of a lidar that has points of all these labels."""
        frame = TransformStamped(child_frame_id='lidar')
        frame.header.frame_id = 'map'
        frame.transform.translation = Vector3(*place)
        frame.transform.rotation.w = 1.0
        self.mast.publish(TFMessage([frame]))
        with self.running(scenario), contextlib.closing(Log('/lidar/points', PointCloud2)) as points:
            message = points.wait(lambda all: next((m for m in all if labels <= set(cloud_of(m)['label'])), None),
                                  'a cloud of ' + scenario)
        return cloud_of(message)

    @contextlib.contextmanager
    def running(self, scenario):
        launch = subprocess.Popen(['roslaunch', 'vegetation_sim', 'field_scenario.launch',
                                   'scenario:=' + scenario])
        try:
            yield
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(DEADLINE)

    def plants_of(self, cloud, labels):
        return {int(p['plant']) for p in cloud if p['label'] in labels}

    # Rows are 2.2 m apart, the slope rises by 8 %, and a post stands every 5.5 m.
    def test_a_lidar_sees_the_rows_of_the_vineyard(self):
        cloud = self.cloud_from('vineyard', (-10.0, 1.1, 0.4), TREES | {GROUND, GRASS, ScanReport.STEM})
        self.assertGreater(len(self.plants_of(cloud, TREES)), 15)
        self.assertGreater(len(self.plants_of(cloud, {ScanReport.STEM})), 2)
        # Shoots keep between their wires, so that the alley is free but for grass.
        wood = cloud[numpy.isin(cloud['label'], list(TREES)) & (abs(cloud['x']) < 5.0)]
        self.assertGreater(abs(wood['y']).min(), 0.4)
        trunks = wood[(wood['label'] == ScanReport.TRUNK) & (abs(wood['y']) < 2.0)]
        self.assertLess(max(abs(abs(trunks['y']) - 1.1)), 0.3)

    def test_a_lidar_sees_the_rows_of_the_orchard(self):
        cloud = self.cloud_from('orchard', (-6.0, 1.75, 0.8), TREES | {GROUND, GRASS, ScanReport.STEM})
        self.assertGreater(len(self.plants_of(cloud, TREES)), 12)
        trunks = cloud[(cloud['label'] == ScanReport.TRUNK) & (abs(cloud['y']) < 3.0)]
        self.assertLess(max(abs(abs(trunks['y']) - 1.75)), 0.4)

    # Below the leaves a robot sees stalks in rows 0.75 m apart.
    def test_a_lidar_sees_the_rows_of_the_maize(self):
        cloud = self.cloud_from('maize', (-6.0, -0.375, 0.5),
                                {GROUND, GRASS, ScanReport.FOLIAGE, ScanReport.STEM})
        self.assertGreater(len(self.plants_of(cloud, {ScanReport.STEM})), 10)
        stems = cloud[(cloud['label'] == ScanReport.STEM) & (abs(cloud['y']) < 0.7)]
        off = [math.remainder(y - 0.375, 0.75) for y in stems['y']]
        self.assertLess(max(map(abs, off)), 0.1)

    # Both rows of the first lane are cut from its beginning on, and the row beside stands.
    def test_a_mower_cuts_two_rows_of_maize(self):
        with self.running('harvest'), contextlib.closing(Log('/canopy/layout', CanopyLayout)) as layout, \
                contextlib.closing(Log('/canopy/state', CanopyState)) as states:
            state = states.wait(lambda all: next((m for m in all if len(m.cut_plants) > 10), None),
                                'cut maize')
            plants = layout.wait(lambda all: all and all[-1].plants, 'the plants')
        self.assertEqual(set(state.cut_heights), {0.12})
        feet = [plants[plant].position for plant in state.cut_plants]
        self.assertEqual({round((p.y + 4.125) / 0.75) for p in feet}, {0, 1})
        end = max(p.x for p in feet) - 0.2
        passed = {i for i, p in enumerate(plants) if p.position.x < end and p.position.y < -3.0}
        self.assertLessEqual(passed, set(state.cut_plants))


if __name__ == '__main__':
    rospy.init_node('field_scenarios_test')
    rostest.rosrun('vegetation_sim', 'field_scenarios', FieldScenarios)
