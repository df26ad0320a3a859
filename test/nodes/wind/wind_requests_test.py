#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests services, settings and markers of wind_broadcaster. Valid requests take effect; bad ones
are rejected with an error that names the field, are counted and have no effect."""
import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure
from geometry_msgs.msg import Point, PointStamped, TransformStamped
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import WindField, WindPrimitive, WindSamples
from vegetation_sim.srv import (GetWindField, RemoveWindPrimitive, SampleWind, SampleWindRequest,
                                SetWindPrimitive)
from visualization_msgs.msg import MarkerArray

from waiting import Latest, wait_for

NODE = '/wind_broadcaster/'
NAN, INF = float('nan'), float('inf')

# Each field with the kinds that use it and values outside its range.
NUMBERS = [
    ('fade_in', [0, 1, 2, 3, 4, 5, 6], [-0.1, 601.0]),
    ('fade_out', [0, 1, 2, 3, 4, 5, 6], [-0.1, 601.0]),
    ('orbit_radius', [0, 2, 3, 4, 5, 6], [-1.0, 1.1e5]),
    ('orbit_period', [0, 2, 3, 4, 5, 6], [-1.0, 1.1e6]),
    ('repeat', [2], [-1.0, 1.1e6]),
    ('radius', [0, 2, 3, 4, 5, 6], [0.0, 1.1e5]),
    ('omega', [0], [-1.0, 101.0]),
    ('phase', [0], [-101.0, 101.0]),
    ('turbulence', [1, 6], [-0.1, 1.1]),
    ('length_scale', [1], [0.5, 1001.0]),
    ('time_scale', [6], [0.0, 601.0]),
    ('front_speed', [2], [-1.0, 201.0]),
    ('rise_length', [2], [0.0, 1.1e4]),
    ('plateau_length', [2, 5], [-1.0, 1.1e4]),
    ('decay_length', [2, 5], [0.0, 1.1e4]),
    ('speed', [3, 4], [-201.0, 201.0]),
    ('core_radius', [3, 4], [0.0, 1.1e4]),
    ('inflow', [3, 5], [-2.1, 2.1]),
    ('updraft', [3], [-2.1, 2.1]),
]


def primitive(kind=WindPrimitive.DISK, name='asked', **fields):
    """Returns a valid request, apart from the given fields."""
    out = WindPrimitive(name=name, kind=kind, fade_in=0.5, fade_out=0.5, radius=8.0, omega=2.0,
                        length_scale=30.0, time_scale=5.0, front_speed=5.0, rise_length=3.0, decay_length=9.0,
                        speed=7.0, core_radius=2.0)
    out.velocity.x = 5.0
    for field, value in fields.items():
        setattr(out, field, value)
    return out


def service(name, kind):
    rospy.wait_for_service(NODE + name, timeout=30.0)
    return rospy.ServiceProxy(NODE + name, kind)


class WindRequests(unittest.TestCase):
    def setUp(self):
        self.set = service('set_primitive', SetWindPrimitive)
        remove = service('remove_primitive', RemoveWindPrimitive)
        self.remove = lambda name='', all=False: remove(name=name, all=all)
        self.get = service('get_field', GetWindField)
        self.sample = service('sample', SampleWind)
        self.reset = service('reset', Trigger)
        self.reconfigure = service('set_parameters', Reconfigure)
        self.assertTrue(self.reset().success)

    def field(self):
        answer = self.get()
        self.assertTrue(answer.success, answer.message)
        return answer.field

    def names(self):
        return [p.name for p in self.field().primitives]

    def last(self, name):
        return [p for p in self.field().primitives if p.name == name][-1]

    def assert_refused(self, answer, text, hash_before):
        self.assertFalse(answer.success)
        self.assertIn(text, answer.message.replace('-nan', 'nan'))
        self.assertEqual(self.field().hash, hash_before)

    def tune(self, **values):
        config = Config(doubles=[DoubleParameter(k, v) for k, v in values.items()])
        return {d.name: d.value for d in self.reconfigure(config).config.doubles}

    def test_starts_with_the_scenario(self):
        self.assertEqual(self.names(), ['breeze', 'disc', 'squall', 'whirl', 'fan', 'draught'])
        self.assertEqual(self.field().seed, 7)
        self.assertEqual(self.field().header.frame_id, 'map')

    def test_takes_one_of_each_kind(self):
        for kind in range(7):
            answer = self.set(primitive(kind, 'new_%d' % kind, orbit_radius=1.0, orbit_period=9.0))
            self.assertTrue(answer.success, answer.message)
            self.assertEqual(self.last('new_%d' % kind).id, answer.id)
            self.assertEqual(self.last('new_%d' % kind).kind, kind)

    # N2: the reply contains the time at which the wind changes.
    def test_says_when_an_edit_begins(self):
        first = self.set(primitive(fade_in=20.0))
        self.assertEqual(first.t_on, self.last('asked').t_on)
        self.assertIn('begins at %d.' % first.t_on.secs, first.message)
        second = self.set(primitive(fade_in=60.0))
        self.assertEqual(second.t_on, first.t_on + rospy.Duration(20))
        third = self.set(primitive(t_on=second.t_on + rospy.Duration(31)))
        self.assertEqual(third.t_on, second.t_on + rospy.Duration(60))
        self.assert_refused(self.set(primitive(t_on=second.t_on + rospy.Duration(29))),
                            'an edit waits for that at most 30', self.field().hash)
        tied = self.set(primitive(4, 'tied', attached_frame='drone'))
        self.assertEqual((tied.id, tied.t_on), (0, rospy.Time()))

    def test_refuses_each_bad_number_with_its_name(self):
        before = self.field().hash
        for name, kinds, outside in NUMBERS:
            for value in outside + [NAN, INF, -INF]:
                with self.subTest(name=name, value=value):
                    answer = self.set(primitive(kinds[-1], **{name: value}))
                    self.assert_refused(answer, "primitive 'asked': %s = " % name, before)

    def test_refuses_each_bad_vector_with_its_name(self):
        before = self.field().hash
        for axis in 'xyz':
            for value in [NAN, INF, -201.0]:
                bad = primitive()
                setattr(bad.velocity, axis, value)
                self.assert_refused(self.set(bad), 'velocity.%s = ' % axis, before)
                bad = primitive(trajectory=[PointStamped()])
                setattr(bad.trajectory[0].point, axis, value * 1e5)
                self.assert_refused(self.set(bad), 'trajectory[0].position.%s = ' % axis, before)

    def test_refuses_wrong_combinations_of_fields(self):
        before = self.field().hash
        point = PointStamped()
        point.header.frame_id = 'odom'
        for bad, text in [
                (primitive(kind=9), 'kind = 9 is none of 0 (disk)'),
                (primitive(envelope=9), 'envelope = 9 is none of'),
                (primitive(name=''), 'name is empty'),
                (primitive(name='x' * 300), 'name has 300 characters, allowed are'),
                (primitive(t_on=rospy.Time(5)), 't_on = 5.000000 s is before'),
                (primitive(t_off=rospy.Time(5)), 't_off = 5.000000 s is not after'),
                (primitive(orbit_radius=2.0), 'orbit_period = 0 s is outside 0.1'),
                (primitive(trajectory=[point]), "frame_id = 'odom' is not 'map' or empty"),
                (primitive(trajectory=[PointStamped(), PointStamped()]), 'is not after'),
                (primitive(trajectory=[PointStamped()] * 4097), 'has 4097 way points'),
                (primitive(kind=1, attached_frame='drone'), 'but a breeze is everywhere'),
                (primitive(kind=5), 'so the centre never moves and has no wake'),
                (primitive(trajectory=[PointStamped()], attached_frame='drone'), 'only one is allowed'),
                (primitive(attached_frame='/drone'), "begins with '/'")]:
            with self.subTest(text=text):
                self.assert_refused(self.set(bad), text, before)

    def test_validates_all_fields_at_once(self):
        answer = self.set(primitive(radius=NAN, omega=-1.0, t_on=rospy.Time(5), envelope=3,
                                    attached_frame='/drone'))
        for text in ['radius = ', 'omega = -1', 't_on = 5', 'envelope = 3', "begins with '/'"]:
            self.assertIn(text, answer.message)

    def test_follows_at_most_four_frames(self):
        for i in range(4):
            self.assertTrue(self.set(primitive(4, 'tied_%d' % i, attached_frame='drone')).success)
        before = self.field().hash
        self.assert_refused(self.set(primitive(4, 'tied_4', attached_frame='drone')),
                            '4 frames are followed already, allowed are 4', before)
        self.assertTrue(self.remove('tied_0').success)
        self.assertTrue(self.set(primitive(4, 'tied_4', attached_frame='drone')).success)

    def test_refuses_to_remove_an_unknown_primitive(self):
        self.assert_refused(self.remove(), "no source is named ''; known sources: breeze, disc",
                            self.field().hash)
        self.assert_refused(self.remove('fann'), "no source is named 'fann'; known sources: breeze, disc",
                            self.field().hash)

    def test_removes_one_or_all(self):
        self.assertTrue(self.remove('fan').success)
        self.assertGreater(self.last('fan').t_off, rospy.Time.now())
        self.assertTrue(self.remove(all=True).success)
        self.assertTrue(all(p.t_off > rospy.Time(0) for p in self.field().primitives))

    def test_refuses_bad_samples(self):
        before = self.field().hash
        many = [Point()] * 100001
        for request, text in [
                (SampleWindRequest(positions=[Point(), Point(x=NAN)]), 'positions[1].x = nan m'),
                (SampleWindRequest(positions=[Point(z=2e6)]), 'positions[0].z = 2e+06 m'),
                (SampleWindRequest(positions=many), 'allowed are 100000'),
                (SampleWindRequest(positions=[Point()] * 3, stamps=[rospy.Time(1)] * 2),
                 'stamps: 2 of them, allowed are 0, 1 or 3')]:
            with self.subTest(text=text):
                answer = self.sample(request)
                self.assert_refused(answer, text, before)
                self.assertEqual(answer.velocities, [])

    def test_samples_at_one_stamp_for_all(self):
        at = rospy.Time.now()
        points = [Point(x=float(i)) for i in range(5)]
        together = self.sample(Header(), points, [at]).velocities
        self.assertEqual(together, self.sample(Header(), points, [at] * 5).velocities)
        self.assertEqual(len(self.sample(Header(), points, []).velocities), 5)
        self.assertEqual(self.sample(Header(), [], []).velocities, [])

    def show(self, **places):
        """Broadcasts static frames that are turned by 90 degrees about z."""
        frames = []
        for name, place in places.items():
            frame = TransformStamped(child_frame_id=name)
            frame.header.frame_id = 'map'
            at, q = frame.transform.translation, frame.transform.rotation
            at.x, at.y, at.z = place
            q.z = q.w = math.sqrt(0.5)
            frames.append(frame)
        self.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        self.frames.publish(frames)

    def test_samples_in_any_frame(self):
        self.show(mast=(1.0, 2.0, 3.0), rotor=(-4.0, 0.0, 2.0))
        at = rospy.Time.now()
        header = Header(frame_id='mast')
        wait_for(lambda: self.sample(header, [], []).success, 'the frame mast')
        # The frame is static, so that it has a transform at each stamp.
        header.stamp = at
        found = self.sample(header, [Point(x=2.0)], [])
        world = self.sample(Header(stamp=at), [Point(1.0, 4.0, 3.0)], [])
        for name in 'xyz':
            self.assertAlmostEqual(getattr(found.velocities[0], name),
                                   getattr(world.velocities[0], name), places=9)
        self.assertEqual((found.header.frame_id, found.header.stamp), ('map', at))
        refused = self.sample(Header(frame_id='nowhere'), [Point()], [])
        self.assert_refused(refused, "frame_id = 'nowhere' is not known in 'map'", self.field().hash)

    # The frame `lost` has no transform.
    def test_publishes_the_wind_at_frames(self):
        self.show(mast=(1.0, 2.0, 3.0), rotor=(-4.0, 0.0, 2.0))
        samples = Latest('/wind/samples', WindSamples)
        message = wait_for(lambda: samples.message and len(samples.message.samples) == 2 and
                           samples.message, 'samples of two frames')
        self.assertEqual([s.frame for s in message.samples], ['mast', 'rotor'])
        self.assertEqual(message.header.frame_id, 'map')
        self.assertEqual(message.samples[0].position, Point(1.0, 2.0, 3.0))
        places = [s.position for s in message.samples]
        expected = self.sample(Header(), places, [message.header.stamp]).velocities
        self.assertEqual([s.velocity for s in message.samples], expected)
        status = Latest('/diagnostics', DiagnosticArray)
        wait_for(lambda: status.message and any(
            "no transform from 'lost' to 'map'" in s.message for s in status.message.status), 'a warning')

    def test_counts_rejected_inputs(self):
        received = []
        rospy.Subscriber('/diagnostics', DiagnosticArray, received.append)

        def status(key):
            found = [v.value for a in received[-1:] for s in a.status for v in s.values
                     if s.name == 'wind_broadcaster: wind law' and v.key == key]
            return found[0] if found else None

        refused = int(wait_for(lambda: status('refused inputs'), 'diagnostics'))
        self.set(primitive(radius=-1.0))
        self.remove('fann')
        wait_for(lambda: int(status('refused inputs')) == refused + 2, 'the count')
        self.assertIn("remove_primitive: no source is named 'fann'", status('last refusal'))
        self.assertEqual(status('hash'), str(self.field().hash))

    def test_reconfigures_the_breeze(self):
        self.assertEqual(self.tune(breeze_speed=6.0, breeze_direction=math.pi / 2)['breeze_speed'],
                         6.0)
        breeze = self.last('breeze')
        self.assertAlmostEqual(breeze.velocity.x, 0.0)
        self.assertAlmostEqual(breeze.velocity.y, 6.0)
        self.assertEqual(breeze.turbulence, 0.25)
        self.assertGreater(breeze.t_on, rospy.Time.now() - rospy.Duration(1))
        self.assertEqual(breeze.epoch, self.field().primitives[0].epoch)

    def test_reconfiguration_rejects_nan_and_clamps_other_values(self):
        before = self.field().hash
        for name in ['breeze_speed', 'breeze_direction', 'breeze_turbulence']:
            value = rospy.get_param(NODE + name)
            self.assertEqual(self.tune(**{name: NAN})[name], value)
            self.assertEqual(self.field().hash, before)
        self.assertEqual(self.tune(breeze_turbulence=7.0)['breeze_turbulence'], 1.0)

    def test_shows_the_breeze_of_other_edits(self):
        updates = Latest(NODE + 'parameter_updates', Config)
        # Without this wait, the edit may come while the subscriber is still connecting.
        wait_for(lambda: updates.message, 'the latched parameter_updates')
        breeze = primitive(WindPrimitive.BREEZE, 'breeze', turbulence=0.5)
        breeze.velocity.x, breeze.velocity.y = 0.0, 3.0
        self.assertTrue(self.set(breeze).success)

        def shown():
            values = {d.name: d.value for d in updates.message.doubles}
            return values['breeze_speed'] == 3.0 and values['breeze_turbulence'] == 0.5

        wait_for(shown, 'the breeze in parameter_updates')

    def test_reset_is_a_fresh_start(self):
        first = self.field()
        self.set(primitive(name='extra'))
        self.tune(breeze_speed=9.0)
        before = rospy.Time.now()
        self.assertTrue(self.reset().success)
        after = self.field()
        self.assertEqual([p.name for p in after.primitives], [p.name for p in first.primitives])
        self.assertEqual([p.id for p in after.primitives], [1, 2, 3, 4, 5, 6])
        self.assertGreater(after.primitives[0].epoch, before)
        self.assertAlmostEqual(rospy.get_param(NODE + 'breeze_speed'), math.sqrt(17.0))

    def test_publishes_every_change(self):
        received = Latest('wind', WindField)
        wait_for(lambda: received.message, 'the latched field')
        self.set(primitive(name='extra'))
        wait_for(lambda: received.message.hash == self.field().hash, 'the edited field')

    def test_marks_every_source_where_it_is(self):
        received = Latest('wind/markers', MarkerArray)

        def together():
            return received.message and {m.ns for m in received.message.markers} >= {
                'wind/direction', 'wind/influence', 'wind/disc', 'wind/front', 'wind/core'}

        wait_for(together, 'markers of every kind')

        def disc():
            return [m.pose.position for m in received.message.markers
                    if m.ns == 'wind/disc' and m.id == 2][0]

        first = disc()
        self.assertAlmostEqual(math.hypot(first.x, first.y), 10.0)
        wait_for(lambda: math.hypot(disc().x - first.x, disc().y - first.y) > 0.5, 'a disc to move')
        self.assertTrue(all(m.header.frame_id == 'map' for m in received.message.markers))
        self.assertTrue(all(m.lifetime > rospy.Duration(0) for m in received.message.markers))


if __name__ == '__main__':
    rospy.init_node('wind_requests_test')
    rostest.rosrun('vegetation_sim', 'wind_requests', WindRequests)
