#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the scans of a lidar in a clearing (N1): labels, wind, trodden grass, REP 117 and jumps
back of the clock."""
import math
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import Point
from std_srvs.srv import Trigger
from vegetation_sim.msg import AgentSpawn, AgentState, InterestDisc, NearAgents, NearGrass, ScanReport, TreadLaw, WindPrimitive
from vegetation_sim.srv import RemoveWindPrimitive, SetWindPrimitive

from crowd_rig import Crowd
from forest_rig import RATE, Animator, TickClock, time_of
from given import given
from grass_rig import Meadow
from scan_rig import INPUTS, Mast, Scanner, cloud_of
from waiting import wait_for
from watched_node import publisher, wait_for_readers

START = 1000 * RATE
WOOD = ScanReport.TRUNK, ScanReport.BRANCH, ScanReport.LEAF
BREEZE = WindPrimitive(name='breeze', kind=WindPrimitive.BREEZE, fade_in=0.5, fade_out=0.5)
BREEZE.velocity.x, BREEZE.turbulence, BREEZE.length_scale = 9.0, 0.3, 20.0


class ScanClearing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.trees, cls.grass, cls.crowd = Animator(), Meadow(), Crowd()
        cls.scanner = Scanner()
        cls.clock = TickClock(START)
        cls.scanner.wait_until_up(*INPUTS)
        cls.crowd.wait_until_up()
        cls.grass.wait_until_up('/wind')
        cls.clock.begin(cls.trees)
        cls.mast = Mast(cls.scanner)
        answer = cls.crowd.spawn(like=AgentSpawn(position=Point(3, 0, 0), stands=True), count=1)
        assert answer.success, answer.message
        cls.run_for(2.0)

    @classmethod
    def run_for(cls, seconds):
        """Runs all nodes. The sensor stands over the middle of the lawn at every tick."""
        for _ in range(int(seconds * RATE)):
            cls.mast.put(0.0, 0.0, 1.2, time_of(cls.clock.tick + 1))
            cls.clock.run(1, cls.trees, cls.grass, cls.crowd)

    def sweep(self):
        """Returns a sweep at a time when all earlier messages have been received."""
        for node in (self.trees, self.grass, self.crowd, self.scanner):
            node.settle()
        self.run_for(2.0 / RATE)
        return cloud_of(self.scan_now(self.scanner.points))

    def scan_now(self, log):
        """Returns the message of the current tick. Time advances by a tick while the scanner has
        not published it."""
        return log.wait(lambda all: all and all[-1].header.stamp == time_of(self.clock.tick) and
                        all[-1], 'a sweep', lambda: self.run_for(1.0 / RATE))

    # N1: the counts of the labels sum to the total.
    def test_1_labels_sum_to_the_number_of_rays(self):
        cloud = self.sweep()
        # The report is sent with the cloud.
        report = self.scanner.report.wait_for_stamp(time_of(self.clock.tick))
        counts = numpy.bincount(cloud['label'], minlength=10)
        self.assertEqual(list(counts[1:]), list(report.counts[1:]))
        self.assertEqual(sum(report.counts), report.rays)
        self.assertEqual(report.rays, 24 * 240)
        self.assertEqual((report.trees, report.left_out), (4, 0))
        for label in range(7):
            self.assertGreater(report.counts[label], 0, label)
        self.assertTrue(set(cloud['plant'][numpy.isin(cloud['label'], WOOD)]) <= {0, 1, 2, 3})
        branches = cloud['branch'][cloud['label'] == ScanReport.BRANCH]
        self.assertTrue(0 < branches.max() < report.branches)
        self.assertTrue((cloud['branch'][cloud['label'] == ScanReport.GROUND] == -1).all())
        ranges = numpy.sqrt(cloud['x'] ** 2 + cloud['y'] ** 2 + cloud['z'] ** 2)
        self.assertTrue(1.0 <= ranges.min() and ranges.max() <= 30.0)
        self.assertTrue(((0.0 <= cloud['intensity']) & (cloud['intensity'] <= 1.0)).all())
        person = cloud[cloud['label'] == ScanReport.PERSON]
        self.assertLess(numpy.hypot(person['x'] - 3.0, person['y']).max(), 0.6)

    # REP 117, REP 103: the ranges of the planar scan agree with the distances in the scene.
    def test_2_a_planar_scan_has_infinities_and_no_nan(self):
        self.sweep()
        scan = self.scan_now(self.scanner.scan)
        ranges = numpy.array(scan.ranges)
        self.assertEqual((len(ranges), scan.header.frame_id), (240, 'lidar'))
        self.assertFalse(numpy.isnan(ranges).any())
        self.assertTrue(numpy.isposinf(ranges).any())
        met = ranges[numpy.isfinite(ranges)]
        self.assertTrue((scan.range_min <= met).all() and (met <= scan.range_max).all())
        angles = scan.angle_min + scan.angle_increment * numpy.arange(240)
        self.assertAlmostEqual(angles[-1], scan.angle_max, 4)
        ahead = ranges[numpy.abs(angles) < 0.06]
        self.assertTrue(((2.5 < ahead) & (ahead < 3.0)).any(), ahead)  # A person stands at 3 m.

    # N1: the test compares scans with the wind off and on.
    def test_3_wind_changes_the_scan_and_still_air_does_not(self):
        one = self.sweep()
        self.run_for(0.3)
        two = self.sweep()
        # A person who stands shifts the weight and looks around.
        still = [cloud[cloud['label'] != ScanReport.PERSON].tobytes() for cloud in (one, two)]
        self.assertTrue(still[0] == still[1])
        rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(primitive=BREEZE)
        self.run_for(1.5)
        windy = self.sweep()
        self.run_for(0.3)
        later = self.sweep()

        def crown(cloud):
            return cloud[numpy.isin(cloud['label'], WOOD) & (cloud['z'] > 0.5)].tobytes()
        self.assertFalse(crown(windy) == crown(two))
        self.assertFalse(crown(windy) == crown(later))
        rospy.ServiceProxy('/wind_broadcaster/remove_primitive', RemoveWindPrimitive)(name='breeze')
        self.run_for(5.0)  # Trees in modes sway until they have left their modes.
        self.assertTrue(crown(self.sweep()) == crown(two))  # The tree is back at rest.

    # N1: trodden grass lowers returns.
    def test_4_trodden_grass_returns_lower(self):
        def lane():
            """Returns the heights above the ground of all points on a lane beside the sensor, and
            the share of grass."""
            cloud = self.sweep()
            place = cloud[(numpy.abs(cloud['y'] - 3.0) < 0.5) & (numpy.abs(cloud['x']) < 4.0)]
            low = place[numpy.isin(place['label'], (ScanReport.GRASS, ScanReport.GROUND))]
            return 1.2 + low['z'], (low['label'] == ScanReport.GRASS).mean()
        before, share = lane()
        self.assertGreater(len(before), 50)
        law = TreadLaw(**given(radius=1.0, reach=1.6, softness=0.1, load=1.0, recovery=1e9))
        answer = self.grass.tread(points=[Point(-6, 3, 0), Point(6, 3, 0)], law=law)
        self.assertTrue(answer.success, answer.message)
        self.run_for(0.5)
        after, share_after = lane()
        self.assertLess(after.mean(), 0.5 * before.mean())
        self.assertLess(share_after, share)

    def test_5_without_its_frame_it_publishes_no_sweep_and_reports_it(self):
        self.sweep()
        last = time_of(self.clock.tick)
        self.scanner.report.wait_for_stamp(last)
        before = self.scanner.diagnostics()['Sweeps without a place']
        self.clock.run(5, self.trees)  # The frame is not published.
        dark = time_of(self.clock.tick)
        wait_for(lambda: self.scanner.diagnostics()['Sweeps without a place'] > before, 'blindness')
        self.sweep()
        self.scanner.report.wait_for_stamp(time_of(self.clock.tick))
        blind = [m.header.stamp for m in self.scanner.report.messages
                 if last < m.header.stamp <= dark]
        self.assertEqual(blind, [])

    def test_6_invalid_people_are_rejected(self):
        people = publisher('/agents/near', NearAgents)
        wait_for_readers('/agents/near', self.scanner.process)
        before = self.scanner.diagnostics()['Inputs refused']
        for height, frame, radius in ((math.nan, 'map', 1.0), (9.0, 'map', 1.0), (1.7, 'elsewhere', 1.0),
                                      (1.7, 'map', -1.0)):
            agent = AgentState(height=height)
            agent.pose.orientation.w = 1.0
            message = NearAgents(agents=[agent], discs=[InterestDisc(radius=radius)])
            message.header.frame_id = frame
            people.publish(message)
            self.scanner.settle()
        wait_for(lambda: self.scanner.diagnostics()['Inputs refused'] == before + 4, 'refusals')
        people.unregister()
        tracks = publisher('/grass/near', NearGrass)
        wait_for_readers('/grass/near', self.scanner.process)
        for discs in ([InterestDisc(radius=-1.0)], [InterestDisc(radius=1.0)] * 65):
            message = NearGrass(discs=discs)
            message.state.header.frame_id = 'map'
            tracks.publish(message)
            self.scanner.settle()
        wait_for(lambda: self.scanner.diagnostics()['Inputs refused'] == before + 6, 'refusals')
        tracks.unregister()
        self.assertGreater((self.sweep()['label'] == ScanReport.PERSON).sum(), 0)

    def test_7_time_that_goes_back_is_a_fresh_start(self):
        here = self.sweep()
        self.clock.show(START - 10 * RATE)
        self.run_for(1.5)
        again = self.sweep()
        trees = [c[numpy.isin(c['label'], WOOD)].tobytes() for c in (here, again)]
        self.assertTrue(trees[0] == trees[1])
        grass = [(1.2 + c['z'][c['label'] == ScanReport.GRASS]).mean() for c in (here, again)]
        # Grass that was trodden at a later time stands again.
        self.assertGreater(grass[1], grass[0])

    def test_8_reset_grows_the_same_trees_anew(self):
        here = self.sweep()
        answer = rospy.ServiceProxy('/vegetation_scanner/reset', Trigger)()
        self.assertTrue(answer.success, answer.message)
        again = self.sweep()
        trees = [c[numpy.isin(c['label'], WOOD)].tobytes() for c in (here, again)]
        self.assertTrue(trees[0] == trees[1])


if __name__ == '__main__':
    rospy.init_node('scan_clearing_test')
    rostest.rosrun('vegetation_sim', 'scan_clearing', ScanClearing)
