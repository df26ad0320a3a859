#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Views of the sky by service and topic: under an oak and in a clearing they are what the rays of a
lidar count, within 2 %."""
import unittest

import numpy
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Point
from std_msgs.msg import Header
from vegetation_sim.msg import ErrorCode, SensorInterest, SkyView, SkyViews, WindPrimitive
from vegetation_sim.srv import GetSkyView, SetWindPrimitive

from forest_rig import RATE, Animator, TickClock, start_node, stop, time_of
from scan_rig import Mast, Scanner, cloud_of
from waiting import wait_for
from watched_node import Log, listens, serves

START = 1000 * RATE
RINGS, COLUMNS = 90, 720
BINS = SkyView.ELEVATIONS, SkyView.AZIMUTHS
UNDER_THE_OAK, CLEARING = (7.0, -4.4, 1.2), (0.0, 0.0, 1.2)
BREEZE = WindPrimitive(name='breeze', kind=WindPrimitive.BREEZE, fade_in=0.5, fade_out=0.5)
BREEZE.velocity.x, BREEZE.turbulence, BREEZE.length_scale = 9.0, 0.3, 20.0
SINES = numpy.sin(numpy.radians(numpy.arange(0, 91, 10)))


def bins_of(view):
    return numpy.reshape(view.transmittance, BINS)


def counted(cloud):
    """Returns the shares of rays without a hit in each bin, and in the hemisphere."""
    hits = numpy.zeros((RINGS, COLUMNS))
    columns = numpy.arctan2(cloud['y'], cloud['x']) / (2 * numpy.pi) * COLUMNS - 0.5
    hits[cloud['ring'], numpy.rint(columns).astype(int) % COLUMNS] = 1
    assert hits.sum() == len(cloud)
    rings = numpy.cos(numpy.radians(numpy.arange(RINGS) + 0.5))
    open_share = 1 - (rings @ hits).sum() / rings.sum() / COLUMNS
    return 1 - hits.reshape(BINS[0], 10, BINS[1], 30).mean(axis=(1, 3)), open_share


class SkyViewTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.trees, cls.scanner = Animator(), Scanner()
        cls.interest = Log('/forest/sensors', SensorInterest)
        cls.clock = TickClock(START)
        cls.scanner.wait_until_up('/wind', '/forest/layout', '/forest/state')
        cls.clock.begin(cls.trees)
        cls.masts = [Mast(cls.scanner, frame) for frame in ('lidar', 'antenna')]
        cls.call = rospy.ServiceProxy('/vegetation_scanner/sky_view', GetSkyView)
        answer = rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(BREEZE)
        assert answer.success, answer.message
        for _ in range(2 * RATE):
            cls.run_tick(CLEARING, CLEARING)

    @classmethod
    def run_tick(cls, lidar, antenna, yaw=0.0):
        """Runs a tick with both frames at places. Returns when all nodes have done it."""
        for node in cls.trees, cls.scanner:
            node.settle()
        for mast, place in zip(cls.masts, (lidar, antenna)):
            mast.put(*place, time_of(cls.clock.tick + 1), yaw)
        cls.clock.run(1, cls.trees)
        cls.scanner.settle()

    def views(self, lidar, antenna, yaw=0.0):
        """Returns the views of a tick, by frame, and the cloud of the lidar."""
        log = Log('/sky_view', SkyViews)
        wait_for(log.connected, log.topic)
        self.run_tick(lidar, antenna, yaw)
        message = log.wait_for_stamp(time_of(self.clock.tick))
        log.close()
        self.assertEqual(message.header.frame_id, 'map')
        self.assertEqual([view.frame for view in message.views], ['lidar', 'antenna'])
        cloud = self.scanner.points.wait_for_stamp(message.header.stamp)
        return message.views, cloud_of(cloud)

    def test_under_an_oak_and_in_a_clearing_it_is_what_rays_count(self):
        for place in (UNDER_THE_OAK, CLEARING):
            (view, _), cloud = self.views(place, CLEARING)
            bins, open_share = counted(cloud)
            rms = numpy.sqrt(((bins_of(view) - bins) ** 2).mean())
            print('at %s: open share %.4f, counted %.4f; bins %.4f' % (place, view.open_share,
                                                                    open_share, rms))
            self.assertAlmostEqual(view.open_share, open_share, delta=0.02)
            self.assertLess(rms, 0.06)
            self.assertEqual(view.left_out, 0)
            self.assertEqual((view.position.x, view.position.y, view.position.z), place)

    def test_the_shares_are_means_of_the_bins(self):
        (oak, clearing), _ = self.views(UNDER_THE_OAK, CLEARING)
        for view in oak, clearing:
            bins = bins_of(view).mean(axis=1)
            self.assertAlmostEqual(view.open_share, bins @ numpy.diff(SINES), places=5)
            # Within a bin the cosine to the zenith differs from its mean.
            self.assertAlmostEqual(view.sky_view_factor, bins @ numpy.diff(SINES ** 2), delta=0.01)
        self.assertLess(oak.sky_view_factor, 0.6)
        self.assertGreater(clearing.sky_view_factor, 0.8)

    def test_directions_are_those_of_the_world(self):
        (straight, _), _ = self.views(CLEARING, CLEARING)
        (turned, _), _ = self.views(CLEARING, CLEARING, yaw=1.5)
        self.assertLess(numpy.abs(bins_of(straight) - bins_of(turned)).mean(), 0.02)
        # The oak is at an azimuth of -32 degrees, and nothing is around 90 degrees.
        self.assertGreater(bins_of(straight)[1, [5, 6]].min(), 0.9)
        self.assertLess(bins_of(straight)[1, 21], 0.5)

    def test_the_service_gives_the_same_views_at_points_and_frames(self):
        views, _ = self.views(UNDER_THE_OAK, CLEARING)
        answer = self.call(header=Header(stamp=time_of(self.clock.tick), frame_id='antenna'),
                           points=[Point(7.0, -4.4, 0.0), Point(0.0, 0.0, 300.0)],
                           frames=['antenna', 'lidar'])
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.header, Header(answer.header.seq, time_of(self.clock.tick), 'map'))
        self.assertEqual([view.frame for view in answer.views], ['', '', 'antenna', 'lidar'])
        for view, same in ((0, 0), (2, 1), (3, 0)):
            self.assertLess(numpy.abs(bins_of(answer.views[view]) - bins_of(views[same])).max(), 1e-5)
        self.assertAlmostEqual(answer.views[1].open_share, 1.0, places=6)

    def test_places_far_apart_have_views_of_their_own(self):
        (near, _), _ = self.views(UNDER_THE_OAK, CLEARING)
        (oak, far), _ = self.views(UNDER_THE_OAK, (400.0, 0.0, 1.2))
        self.assertLess(numpy.abs(bins_of(near) - bins_of(oak)).mean(), 0.02)  # a tick of wind
        self.assertAlmostEqual(far.open_share, 1.0, places=6)

    def test_bad_requests_are_rejected_by_name(self):
        nan = float('nan')
        for words, code, request in (
                ('points and frames have 0 entries', ErrorCode.INVALID_VALUE, {}),
                ('points and frames have 65 entries', ErrorCode.INVALID_VALUE,
                 dict(points=[Point()] * 64, frames=['antenna'])),
                ('points[1].z = nan m is not finite', ErrorCode.INVALID_VALUE,
                 dict(points=[Point(), Point(0, 0, nan)])),
                ('points[0].x = 2e+07 m is outside', ErrorCode.INVALID_VALUE,
                 dict(points=[Point(2e7, 0, 0)])),
                ('frames[1] is empty', ErrorCode.INVALID_VALUE, dict(frames=['antenna', ''])),
                ("frames[0]: frame_id = 'nowhere'", ErrorCode.NO_TRANSFORM, dict(frames=['nowhere'])),
                ("frame_id = 'nowhere'", ErrorCode.NO_TRANSFORM,
                 dict(points=[Point()], header=Header(frame_id='nowhere'))),
                ('stamp is not that of the last tick', ErrorCode.NOT_AVAILABLE,
                 dict(points=[Point()], header=Header(stamp=rospy.Time(1))))):
            answer = self.call(**request)
            self.assertIn(words, answer.message)
            self.assertEqual((answer.success, answer.error_code, answer.views), (False, code, []))

            def refusal(words=words):
                status = self.scanner.status()
                return status.level == DiagnosticStatus.WARN and words in status.message
            wait_for(refusal, 'a warning with the words ' + words)

    def test_a_scanner_of_another_world_knows_no_sky(self):
        name = '/astray/vegetation_scanner'
        process = start_node('vegetation_scanner', name, {'forest/layout': '/forest/layout'}, frame_id='elsewhere',
                             lidar_frame='')
        self.addCleanup(stop, process)
        wait_for(lambda: listens(name, '/forest/layout') and listens(name, '/clock'), name)

        def is_offered():
            self.run_tick(CLEARING, CLEARING)
            return serves(name + '/sky_view')
        wait_for(is_offered, name + '/sky_view')
        answer = rospy.ServiceProxy(name + '/sky_view', GetSkyView)(points=[Point(*UNDER_THE_OAK)])
        self.assertEqual((answer.success, answer.error_code, answer.views), (False, ErrorCode.NOT_AVAILABLE, []))
        self.assertIn("forest/layout: Rejected a message: frame_id = 'map'", answer.message)

    def test_a_missing_frame_is_reported(self):
        def warning():
            self.run_tick(CLEARING, CLEARING)
            status = self.scanner.status()
            return (status.level == DiagnosticStatus.WARN and
                    "no transform from 'lost' to 'map'" in status.message)
        wait_for(warning, 'a warning')

    def test_views_are_made_for_subscribers_alone_and_places_are_announced_in_any_case(self):
        self.views(CLEARING, CLEARING)  # Its log is closed.
        self.run_tick(CLEARING, CLEARING)
        before = self.scanner.diagnostics()['Views of the sky']
        for _ in range(3):
            self.run_tick(CLEARING, UNDER_THE_OAK)
        self.assertEqual(self.scanner.diagnostics()['Views of the sky'], before)
        self.views(CLEARING, CLEARING)
        self.assertGreater(self.scanner.diagnostics()['Views of the sky'], before)
        sensors = {m.id: m for m in self.interest.messages}
        self.assertEqual(set(sensors), {'/vegetation_scanner', '/vegetation_scanner/sky/lidar',
                                        '/vegetation_scanner/sky/antenna'})
        self.assertEqual(sensors['/vegetation_scanner/sky/antenna'].range, 50.0)


if __name__ == '__main__':
    rospy.init_node('sky_view_test')
    rostest.rosrun('vegetation_sim', 'sky_view', SkyViewTest)
