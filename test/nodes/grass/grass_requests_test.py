#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the services of grass_field. Bad inputs are rejected with an error that names the field and
have no effect."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped, Vector3
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from vegetation_sim.msg import GrassColour, GrassColours, GrassCover, GrassCut, TreadEvent, TreadLaw
from visualization_msgs.msg import MarkerArray

from forest_rig import TickClock
from given import given
from grass_rig import FULL, RATE, Feet, Meadow, nodes_of, step, time_of
from watched_node import Log, serves

NAN, INF = float('nan'), float('inf')


def points(*places):
    return [Point(x, y, 0.0) for x, y in places]


class GrassRequests(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.clock = TickClock(1000 * RATE)
        cls.grass.wait_until_up()
        cls.early = serves('/grass_field/sample')
        cls.feet = Feet(cls.grass)
        cls.clock.run(1, cls.grass)

    # N7: without a viewer the default viewer above the lawn is used, whose demand exceeds the
    # budget of blades.
    def test_governor_reports_levels_and_reason(self):
        log = Log('/grass/markers', MarkerArray)
        log.wait(len, 'markers', lambda: self.clock.run(3, self.grass))
        values = self.grass.diagnostics('governor')
        error = self.grass.predicted_errors('/grass/errors')['grass/markers']
        log.close()
        # N9: a tile that the budget holds back is off by the height or the spacing of its blades.
        self.assertAlmostEqual(error.pixels, values['Largest predicted error [pixel]'], places=3)
        self.assertTrue(0.01 < error.metres < 0.5, error.metres)
        self.assertGreater(error.held_back, 0)
        self.assertLessEqual(error.cost, error.budget)
        self.assertGreater(error.wanted, 10 * error.budget)
        self.assertGreater(values['Cost that the tolerance asks for [blades]'],
                           10 * values['Budget [blades]'])
        self.assertLessEqual(values['Cost [blades]'], values['Budget [blades]'])
        self.assertGreater(values['Cost [blades]'], 0)
        self.assertGreater(values['Tiles that the budget holds back'], 0)
        self.assertGreater(values['Tiles: of blades'], 0)
        self.assertLessEqual(values['Marker points'], values['Marker budget [points]'])
        self.assertEqual(values['Complete states every [s]'], 2.0)
        self.assertGreater(values['Complete states [B/s]'], 0)

    def call(self, service, **request):
        answer = service(**request)
        self.assertTrue(answer.success, answer.message)
        self.clock.run(1, self.grass)
        return answer

    def ground(self):
        """Returns the state of all trodden blocks."""
        self.grass.state.wait_for_stamp(time_of(self.clock.tick))
        while not self.grass.state.messages[-1].key_frame:
            self.clock.run(1, self.grass)
        return nodes_of(self.grass.state.messages[-1])

    def test_nothing_is_sampled_before_time_begins(self):
        self.assertFalse(self.early)

    # S2-21, S2-22: a path of any length is applied at one tick with its own tread law.
    def test_a_path_is_trodden_at_one_tick(self):
        answer = self.call(self.grass.tread, points=points((-15, 10), (15, 10), (15, 12)),
                           law=TreadLaw(**given(radius=0.3, recovery=1e9)))
        self.assertAlmostEqual(answer.length, 32.0)
        for x in (-15.0, -7.3, 0.0, 14.9):
            self.assertGreater(self.grass.at(x, 10.2).tilt, FULL - 1e-6)
            self.assertEqual(self.grass.at(x, 11.0).tilt, 0.0 if x < 14.0 else
                             self.grass.at(x, 11.0).tilt)
        self.assertGreater(self.grass.at(15.0, 11.5).tilt, FULL - 1e-6)
        stamps = {node[3] for node in self.ground().values() if node[4] == 1e9}
        self.assertEqual(len(stamps), 1)
        self.assertEqual(self.grass.diagnostics()['Jumps of sources'], 0)

    # S2-21: a single point is a footprint.
    def test_a_single_point_is_a_footprint(self):
        self.call(self.grass.tread, points=points((-10, -10)), law=TreadLaw(**given(recovery=1e9)))
        self.assertGreater(self.grass.at(-10.0, -10.05).tilt, FULL - 1e-6)
        self.assertEqual(self.grass.at(-10.0, -9.5).tilt, 0.0)

    # A given 0 is no default: a source without load leaves no track.
    def test_a_load_of_zero_treads_nothing(self):
        self.call(self.grass.tread, points=points((-10, -17)), law=TreadLaw(**given(load=0.0)))
        self.assertEqual(self.grass.at(-10.0, -17.0).tilt, 0.0)

    def test_a_stamped_request_waits_for_its_stamp(self):
        later = time_of(self.clock.tick + 10)
        answer = self.grass.tread(header=Header(stamp=later), points=points((-10, -14)))
        self.assertTrue(answer.success, answer.message)
        self.clock.run(9, self.grass)
        self.assertEqual(self.grass.at(-10.0, -14.0).tilt, 0.0)
        self.clock.run(1, self.grass)
        self.assertGreater(self.grass.at(-10.0, -14.0).tilt, FULL - 1e-6)

    # S2-18: discs colour the grass, move, and reach late subscribers.
    def test_discs_colour_the_grass(self):
        plain = self.grass.at(4.0, 4.0).colour
        disc = GrassColour(x=4.0, y=4.0, radius=3.0, colour=1.0, weight=3.0, velocity_x=-2.0)
        self.call(self.grass.set_colours, colours=[disc])
        log = Log('/grass/colours', GrassColours)
        log.wait(len, 'colours')
        message = log.messages[-1]
        self.assertEqual(message.header.frame_id, 'map')
        self.assertEqual(message.colours, [disc])
        start = message.header.stamp
        there, beyond = self.grass.samples([(2.0, 4.0), (8.0, 4.0)], start + rospy.Duration(1))
        self.assertAlmostEqual(there.colour, (plain + 3.0) / 4.0)
        self.assertAlmostEqual(beyond.colour, plain)
        answer = self.grass.set_colours(colours=[GrassColour(radius=1.0, colour=NAN)])
        self.assertFalse(answer.success)
        self.assertIn('colours[0].colour = nan', answer.message)
        self.call(self.grass.set_colours, colours=[])
        self.assertAlmostEqual(self.grass.at(4.0, 4.0).colour, plain)
        log.close()

    def cut_of(self, height, *places, **fields):
        return dict(cut=GrassCut(outline=points(*places), height=height, **fields))

    # Stubble and swath are exact; drag and planner's map follow the lower height.
    def test_a_cut_leaves_stubble_and_swath(self):
        before = self.grass.at(-17.0, 3.0)
        self.call(self.grass.cut, **self.cut_of(0.06, (-18.0, 2.0), (-16.0, 2.0), (-16.0, 4.0),
                                                (-18.0, 4.0)))
        self.call(self.grass.cut, **self.cut_of(0.06, (19.0, 19.0), (20.1, 19.0), (20.1, 20.1),
                                                (19.0, 20.1)))
        cut, beside = self.grass.samples([(-17.0, 3.0), (-15.9, 3.0)])
        self.assertEqual((before.cut, cut.cut, beside.cut), (False, True, False))
        self.assertAlmostEqual(cut.height, 0.06, places=7)
        self.assertAlmostEqual(cut.resistance, before.resistance * 0.06 / before.height, places=5)
        self.assertGreater(cut.swath, 0.01)
        self.assertEqual(beside.swath, 0.0)
        log = Log('/grass/cover/values', GrassCover)
        cover = log.wait(lambda all: all and all[-1], 'the cover map',
                         lambda: self.clock.run(RATE, self.grass))
        log.close()
        info = cover.info

        def index(x, y):
            return (int((y - info.origin.position.y) / info.resolution) * info.width +
                    int((x - info.origin.position.x) / info.resolution))
        # A cell on the border of the map has more nodes.
        for x, y in ((-17.1, 3.1), (19.9, 19.9), (19.9, 19.4)):
            self.assertAlmostEqual(cover.cut[index(x, y)], 1.0, places=5)
            self.assertAlmostEqual(cover.height[index(x, y)], 0.06, places=5)
        self.assertAlmostEqual(cover.swath[index(-17.1, 3.1)], cut.swath, delta=0.3 * cut.swath)
        self.assertEqual(cover.cut[index(-15.5, 3.1)], 0.0)

    def test_bad_cuts_are_refused_by_name(self):
        for text, request in (
                ('outline has 0 points, allowed are 3 to 1000, or 1 with a radius',
                 self.cut_of(0.1)),
                ('outline[0].x = nan m is not finite', self.cut_of(0.1, (NAN, 0), radius=1.0)),
                ('radius = -1 m is outside 0 to 1000 m',
                 self.cut_of(0.1, (0, 0), (1, 0), (1, 1), radius=-1.0)),
                ('height = 9 m is outside 0 to 5 m', self.cut_of(9.0, (0, 0), radius=1.0)),
                ("'nowhere' is not known in 'map'",
                 dict(self.cut_of(0.1, (0, 0), radius=1.0), header=Header(frame_id='nowhere')))):
            self.expect_refused(text, self.grass.cut, **request)

    # S2-02, S2-04: a sample has the features of the map, which is twice as dense in the east.
    def test_a_sample_has_all_values_of_a_point(self):
        west, east, outside = self.grass.samples([(-10.0, 5.0), (10.0, 5.0), (25.0, 0.0)])
        self.assertAlmostEqual(west.density, 800 * 128 / 255, places=6)
        self.assertAlmostEqual(east.density, 800.0, places=6)
        self.assertEqual((west.inside, east.inside, outside.inside), (True, True, False))
        self.assertEqual(outside.density, 0.0)
        self.assertAlmostEqual(west.height, 0.3)
        self.assertAlmostEqual(sum(west.shares), 1.0)
        self.assertAlmostEqual(west.shares[1], 0.2)
        self.assertEqual((west.tilt, west.crush, west.age), (0.0, 0.0, -1.0))
        self.assertAlmostEqual(east.resistance, 0.2 * 800.0 * 0.3)
        self.assertEqual(west.wind.x, 0.0)

    def test_clear_raises_a_disc_or_all(self):
        self.call(self.grass.tread, points=points((-5, -5), (5, -5)))
        self.call(self.grass.clear, centre=PointStamped(point=Point(0, -5, 0)), radius=0.0)
        self.assertGreater(self.grass.at(1.9, -5.0).tilt, 1.4)
        self.call(self.grass.clear, centre=PointStamped(point=Point(0, -5, 0)), radius=2.0)
        self.assertEqual(self.grass.at(1.9, -5.0).tilt, 0.0)
        self.assertGreater(self.grass.at(2.2, -5.0).tilt, 1.4)
        self.assertTrue(self.grass.state.messages[-1].key_frame)
        self.call(self.grass.clear, all=True)
        self.assertEqual(self.ground(), {})

    def test_reset_is_a_fresh_start(self):
        self.call(self.grass.tread, points=points((-5, 0), (5, 0)))
        self.assertTrue(self.ground())
        answer = rospy.ServiceProxy('/grass_field/reset', Trigger)()
        self.assertTrue(answer.success, answer.message)
        self.clock.run(1, self.grass)
        self.assertEqual(self.ground(), {})
        self.assertEqual([m.sequence for m in self.grass.state.messages if m.header.stamp ==
                          time_of(self.clock.tick)][-1] < 100, True)

    def expect_refused(self, text, service, **request):
        before = self.ground()
        answer = service(**request)
        self.assertFalse(answer.success, text)
        self.assertIn(text, answer.message.replace('-nan', 'nan'))
        self.clock.run(1, self.grass)
        self.assertEqual(self.ground(), before)

    def test_bad_requests_are_rejected_with_an_error_that_names_the_field(self):
        tread, clear = self.grass.tread, self.grass.clear
        self.expect_refused('points has 0 entries, allowed are 1 to 10000', tread)
        self.expect_refused('points[1].x = nan m is not finite', tread,
                            points=points((0, 0), (NAN, 0)))
        self.expect_refused('points[1].y = 20.5 m is outside -20 to 20 m', tread,
                            points=points((0, 0), (0, 20.5)))
        for radius in -1, 7:
            answer = tread(points=points((0, 0)), law=TreadLaw(**given(radius=radius)))
            self.assertEqual((answer.success, answer.message),
                             (False, 'law: radius = %d m is outside 0.005 to 5 m' % radius))
        self.expect_refused('reach = 0.2', tread, points=points((0, 0)),
                            law=TreadLaw(**given(radius=0.2, reach=0.2)))
        self.expect_refused('law: radius = 0 m is outside 0.005 to 5 m', tread,
                            points=points((0, 0)), law=TreadLaw(**given(radius=0.0)))
        self.expect_refused('law: radius = 0.3 needs has_radius = true', tread,
                            points=points((0, 0)), law=TreadLaw(radius=0.3))
        self.expect_refused("frame_id = 'nowhere' is not known in 'map'", tread,
                            header=Header(frame_id='nowhere'), points=points((0, 0)))
        self.expect_refused('s ahead, allowed are 60', tread, points=points((0, 0)),
                            header=Header(stamp=time_of(self.clock.tick + 100 * RATE)))
        self.expect_refused('more steps of 2.5', tread, points=points(*[
            ((-19, 0), (19, 0))[i % 2] for i in range(1000)]))
        self.expect_refused('radius = nan m is not finite', clear, radius=NAN)
        self.expect_refused('centre.x = inf m', clear, radius=1.0,
                            centre=PointStamped(point=Point(INF, 0, 0)))
        for request, text in (
                (dict(points=[]), 'points has 0 entries'),
                (dict(points=points((NAN, 0))), 'points[0].x = nan m'),
                (dict(points=points((0, 0)), header=Header(frame_id='nowhere')), "'nowhere'"),
                (dict(points=points((0, 0)), header=Header(stamp=rospy.Time(1))),
                 'the past is not kept')):
            self.assertIn(text, self.grass.refusal(**request).replace('-nan', 'nan'))

    # Log and diagnostics name each rejected input; the state does not change.
    def test_bad_treads_are_refused_and_counted(self):
        before, refused = self.ground(), self.grass.diagnostics()['Inputs refused']
        good = step('x', 1.0, 1.0)
        bad = [step('', 1.0, 1.0), step('x', NAN, 1.0), step('x', 1.0, INF), step('x', 1e9, 0.0),
               step('x' * 300, 1.0, 1.0), step('x', 1.0, 1.0, action=9),
               step('x', 1.0, 1.0, law={'radius': -0.1}), step('x', 1.0, 1.0, law={'load': NAN}),
               step('x', 1.0, 1.0, height_gate=-2.0),
               TreadEvent(source='x', height_gate=1.0),
               TreadEvent(source='x', velocity=Vector3(1.0, 0.0, 0.0))]
        lost = TreadEvent(source='x')
        lost.header.frame_id = 'no_such_frame'
        self.feet.send(*(bad + [lost]))
        self.clock.run(1, self.grass)
        self.assertEqual(self.ground(), before)
        self.assertEqual(self.grass.diagnostics()['Inputs refused'], refused + len(bad) + 1)
        self.feet.send(good)
        self.clock.run(1, self.grass)
        self.assertNotEqual(self.ground(), before)

    # A step of length zero has no effect. A step that is longer than the limit leaves no track.
    def test_zero_length_and_teleporting_steps(self):
        self.feet.walk(self.clock, 'robot', (-9.0, 15.0), (-7.0, 15.0), RATE)
        held = self.grass.at(-7.0, 15.0).tilt
        self.feet.send(step('robot', -7.0, 15.0), step('robot', -7.0, 15.0))
        self.clock.run(1, self.grass)
        self.assertAlmostEqual(self.grass.at(-7.0, 15.0).tilt, held, delta=1e-3)
        jumps = self.grass.diagnostics()['Jumps of sources']
        self.feet.send(step('robot', 9.0, 15.0))
        self.clock.run(1, self.grass)
        self.assertEqual(self.grass.diagnostics()['Jumps of sources'], jumps + 1)
        self.assertEqual(self.grass.at(1.0, 15.0).tilt, 0.0)
        self.assertGreater(self.grass.at(9.0, 15.0).tilt, 1.4)


if __name__ == '__main__':
    rospy.init_node('grass_requests_test')
    rostest.rosrun('vegetation_sim', 'grass_requests', GrassRequests)
