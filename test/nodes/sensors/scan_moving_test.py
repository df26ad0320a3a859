#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of a sensor that moves within a sweep, with two returns, and the leaves of canopy_animator
in them (N1)."""
import unittest

import numpy
import rospy
import rostest
from vegetation_sim.msg import ScanReport

from canopy_rig import Leaves
from forest_rig import RATE, TickClock, time_of
from scan_rig import Mast, Scanner, cloud_of

START = 1000 * RATE
RISE = 1.5  # [m/s]
TURN = 0.1  # [s] duration of a sweep
PLACE = -4.0, 0.5


class ScanMoving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.leaves = Leaves()
        cls.scanners = Scanner(), Scanner('/raw/vegetation_scanner', '/raw/')
        cls.clock = TickClock(START)
        for scanner in cls.scanners:
            scanner.wait_until_up('/canopy/layout', '/canopy/state')
        cls.leaves.wait_until_up('/wind')
        cls.clock.begin(cls.leaves)
        cls.masts = [Mast(*pair) for pair in zip(cls.scanners, ('lidar', 'raw_lidar'))]
        cls.begun = cls.clock.tick
        while cls.clock.tick < cls.begun + 2 * RATE:
            stamp = time_of(cls.clock.tick + 1)
            for mast in cls.masts:
                mast.put(*PLACE, cls.height_at(stamp), stamp)
            cls.clock.run(1, cls.leaves)
            for node in (cls.leaves, *cls.scanners):
                node.settle()

    @classmethod
    def height_at(cls, stamp):
        return 1.0 + RISE * (stamp - time_of(cls.begun)).to_sec()

    def clouds(self, scanner):
        out = [(m.header.stamp, cloud_of(m)) for m in scanner.points.messages]
        self.assertGreater(len(out), 10)
        return out

    def heights_of_ground(self, scanner):
        """Yields for each sweep how much higher above the ground the sensor was, as seen in the
        points, than at the stamp, the times of the points [s], and their largest error [m]: the
        mean of a beam of 3 mrad may lie half of its width beside its axis."""
        for stamp, cloud in self.clouds(scanner):
            ground = cloud[cloud['label'] == ScanReport.GROUND]
            self.assertGreater(len(ground), 100)
            ranges = numpy.sqrt(ground['x'] ** 2 + ground['y'] ** 2 + ground['z'] ** 2)
            self.assertLess(ranges.min(), 16.0)
            yield -ground['z'] - self.height_at(stamp), ground['time'], 0.005 + 0.0015 * ranges

    def test_deskewed_points_are_in_the_frame_at_the_stamp(self):
        for rise, time, error in self.heights_of_ground(self.scanners[0]):
            self.assertTrue((numpy.abs(rise) < error).all())
            self.assertGreater(time.max(), 0.8 * TURN)

    def test_raw_points_are_in_the_frame_of_their_ray(self):
        for rise, time, error in self.heights_of_ground(self.scanners[1]):
            self.assertTrue((numpy.abs(rise - RISE * time) < error).all())
            self.assertTrue((0.0 <= time).all() and (time < TURN).all())

    def test_the_planar_scan_has_the_time_of_its_rays(self):
        scan = self.scanners[0].scan.messages[-1]
        self.assertAlmostEqual(scan.time_increment, TURN / 360, 6)
        self.assertAlmostEqual(scan.range_max, 100.0, 3)  # of the preset

    def test_leaves_and_stems_are_seen_where_the_plants_are(self):
        stamp, cloud = self.clouds(self.scanners[0])[2]
        report = next(m for m in self.scanners[0].report.messages if m.header.stamp == stamp)
        self.assertEqual((report.plants, report.leaves, report.plants_left_out), (2, 400, 0))
        for label in (ScanReport.FOLIAGE, ScanReport.STEM):
            seen = cloud[cloud['label'] == label]
            self.assertGreater(len(seen), 5)
            self.assertEqual(set(seen['plant']), {0, 1})
            first = seen[seen['plant'] == 0]
            away = numpy.hypot(first['x'] + PLACE[0], first['y'] + PLACE[1])
            self.assertLess(away.max(), 1.6)
            self.assertEqual(report.counts[label], len(seen))

    def test_a_beam_with_two_echoes_has_two_points(self):
        _, cloud = self.clouds(self.scanners[0])[2]
        report = self.scanners[0].report.messages[2]
        self.assertEqual(sum(report.counts), report.rays + report.second_returns)
        self.assertEqual(report.rays, 16 * 360)
        types = numpy.bincount(cloud['return_type'], minlength=8)
        self.assertEqual(types[3] + types[4], report.second_returns)
        self.assertEqual(types[5] + types[6], report.second_returns)
        self.assertGreater(report.second_returns, 10)
        self.assertGreater(types[7], 100)
        self.assertEqual(types[:3].sum(), 0)
        self.assertEqual(set(self.clouds(self.scanners[1])[2][1]['return_type']), {1})


if __name__ == '__main__':
    rospy.init_node('scan_moving_test')
    rostest.rosrun('vegetation_sim', 'scan_moving', ScanMoving)
