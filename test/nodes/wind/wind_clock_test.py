#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests wind_broadcaster as node and nodelet with a clock that waits, runs at 20 times wall time,
stops and jumps back."""
import math
import signal
import subprocess
import unittest

import roslib.packages
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, TransformStamped
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import WindField, WindPrimitive
from vegetation_sim.srv import GetWindField, SampleWind, SetWindPrimitive

from waiting import Latest, SimulatedClock, wait_for
from watched_node import Log, serves

NODE, NODELET = '/node/wind_broadcaster/', '/nodelet/wind_broadcaster/'
START = rospy.Time(1000, 250000000)
POINTS = [Point(x=3.0 * i, y=-2.0 * i, z=1.0) for i in range(6)]


class Broadcaster:
    """Client of one broadcaster."""

    def __init__(self, prefix):
        self.prefix = prefix
        self.get = rospy.ServiceProxy(prefix + 'get_field', GetWindField)
        self.sample = rospy.ServiceProxy(prefix + 'sample', SampleWind)
        self.set = rospy.ServiceProxy(prefix + 'set_primitive', SetWindPrimitive)

    def field_from(self, start):
        """Waits for the field of a start at this stamp and returns it."""
        self.get.wait_for_service(timeout=30.0)
        def found():
            answer = self.get()
            return answer.success and answer.field.primitives[0].epoch == start and answer.field
        return wait_for(found, 'a start at %s' % start)

    def now_is(self, stamp):
        """Waits until the broadcaster has received this stamp."""
        wait_for(lambda: self.get().field.header.stamp == stamp, 'time %s' % stamp)


class WindClock(unittest.TestCase):
    # The tests run in the order of their names, because they share one clock.
    @classmethod
    def setUpClass(cls):
        cls.clock = SimulatedClock()
        cls.topic = Latest('/node/wind', WindField)
        cls.node, cls.nodelet = Broadcaster(NODE), Broadcaster(NODELET)
        cls.both = [cls.node, cls.nodelet]
        cls.clock.wait_for_listeners(3)  # the node, the nodelet manager and this test

    def start_at(self, stamp):
        """Makes the clock jump. Returns the common hash of the fields that start at the stamp."""
        self.clock.set(stamp)
        hashes = [b.field_from(stamp).hash for b in self.both]
        self.assertEqual(hashes[0], hashes[1])
        return hashes[0]

    def test_1_waits_while_time_is_zero(self):
        for broadcaster in self.both:
            for name in ('get_field', 'sample', 'set_primitive', 'remove_primitive', 'reset'):
                self.assertFalse(serves(broadcaster.prefix + name), name)
        self.assertEqual(self.topic.count, 0)

    def test_2_starts_with_the_first_stamp_alike_in_node_and_nodelet(self):
        field_hash = self.start_at(START)
        wait_for(lambda: self.topic.message, 'the field')
        self.assertEqual(self.topic.message.hash, field_hash)
        self.assertEqual(self.topic.message.header.stamp, START)
        self.assertEqual(self.node.sample(Header(), POINTS, [START + rospy.Duration(7)]).velocities,
                         self.nodelet.sample(Header(), POINTS, [START + rospy.Duration(7)]).velocities)

    def test_3_runs_at_20_times_its_pace(self):
        self.clock.run(10.0)
        end = START + rospy.Duration(10)
        for broadcaster in self.both:
            broadcaster.now_is(end)
            self.assertEqual(broadcaster.sample(Header(), POINTS, []).velocities,
                             broadcaster.sample(Header(), POINTS, [end]).velocities)
        self.assertNotEqual(self.node.sample(Header(), POINTS, []).velocities,
                            self.node.sample(Header(), POINTS, [START]).velocities)

    def test_4_moves_nothing_while_time_stands(self):
        first = self.node.sample(Header(), POINTS, []).velocities
        published = self.topic.count
        for _ in range(100):
            self.assertEqual(self.node.sample(Header(), POINTS, []).velocities, first)
        self.assertEqual(self.topic.count, published)

    def test_5_edits_take_effect_by_the_lead_in_simulated_time(self):
        edit = WindPrimitive(name='disc', kind=WindPrimitive.DISK, radius=9.0, fade_in=1.0,
                             fade_out=1.0, omega=2.0)
        edit.velocity.x = 3.0
        self.assertTrue(self.node.set(edit).success)
        new = self.node.get().field.primitives[-1]
        self.assertEqual(new.t_on, self.clock.now + rospy.Duration.from_sec(0.2))
        self.assertNotEqual(self.node.get().field.hash, self.nodelet.get().field.hash)

    # Not to the stamp of the first start, whose field has the same epoch.
    def test_6_back_by_ten_seconds_is_a_fresh_start(self):
        back = START + rospy.Duration(0, 1)
        after = self.start_at(back)
        wait_for(lambda: self.topic.message.hash == after, 'the new field on the topic')
        self.assertEqual(after, self.hash_of_a_fresh_node(back))

    def test_7_so_is_back_by_a_tenth_of_a_second_but_no_smaller_step(self):
        self.clock.run(1.0)
        now = self.clock.now
        before = [b.get().field for b in self.both]
        self.clock.set(now - rospy.Duration(0, 100000000))
        self.clock.set(now + rospy.Duration(0, 1))
        for broadcaster, field in zip(self.both, before):
            broadcaster.now_is(now + rospy.Duration(0, 1))
            self.assertEqual(broadcaster.get().field.hash, field.hash)
        self.start_at(now - rospy.Duration(0, 100000000))

    def test_8_blows_where_a_frame_goes_until_it_is_lost(self):
        tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        blast = WindPrimitive(name='rotor', kind=WindPrimitive.BLAST, radius=6.0, core_radius=1.0,
                              speed=20.0, fade_in=0.5, fade_out=0.5, attached_frame='drone')
        answer = self.node.set(blast)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.message, 'begins once tf has a transform of drone')
        wait_for(lambda: tf.get_num_connections() > 0, 'a listener of /tf')
        wait_for(lambda: self.downwash_after(0.5, tf) > 12.0, 'wind below the drone')
        self.assertLess(self.pieces(), 40)

        reports = Log('/diagnostics', DiagnosticArray)
        self.clock.run(4.0)  # The frame is not published.
        self.node.now_is(self.clock.now)
        self.assertLess(self.downwash(), 1e-9)
        self.warning(reports, "no transform from 'drone' to 'map'")

        self.clock.run(8.0)
        wait_for(lambda: self.downwash_after(0.5, tf) > 12.0, 'the wind to come back')

    def test_8_starts_anew_where_a_frame_jumps(self):
        tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        wait_for(lambda: tf.get_num_connections() > 0, 'a listener of /tf')
        reports = Log('/diagnostics', DiagnosticArray)
        wait_for(lambda: self.downwash_after(0.5, tf) > 12.0, 'wind below the drone')
        self.east = 1000.0
        wait_for(lambda: self.downwash_after(0.5, tf) > 12.0, 'wind where the drone is now')
        self.assertIn('m/s is outside 0 to 200 m/s', self.warning(reports, "frame 'drone': speed = "))

    # A few seconds later no stamp fits a message, and timers of roscpp fail.
    def test_9_lives_on_at_the_end_of_time(self):
        self.clock.set(rospy.Time(4294967290, 0))
        self.clock.set(rospy.Time(4294967200, 0))  # the fan of the scene would end too late
        self.clock.set(START)
        for broadcaster in self.both:
            self.assertEqual(broadcaster.field_from(START).header.frame_id, 'map')

    def hash_of_a_fresh_node(self, stamp):
        executable = roslib.packages.find_node('vegetation_sim', 'wind_broadcaster')[0]
        rospy.set_param('/fresh/wind_broadcaster', {'scenario': rospy.get_param('~scenario')})
        node = subprocess.Popen([executable, '__ns:=/fresh'])
        try:
            return Broadcaster('/fresh/wind_broadcaster/').field_from(stamp).hash
        finally:
            node.send_signal(signal.SIGINT)
            self.assertEqual(node.wait(), 0)

    east = 50.0

    def drone(self, stamp):
        """Returns the frame on a circle of 20 m at 5 m/s, `east` [m] of the other sources."""
        angle = 0.25 * stamp.to_sec()
        out = TransformStamped()
        out.header.stamp = stamp
        out.header.frame_id = 'map'
        out.child_frame_id = 'drone'
        out.transform.translation.x = self.east + 20.0 * math.cos(angle)
        out.transform.translation.y = 20.0 * math.sin(angle)
        out.transform.translation.z = 8.0
        out.transform.rotation.w = 1.0
        return out

    def downwash_after(self, seconds, tf):
        self.clock.run(seconds, each=lambda now: tf.publish(TFMessage([self.drone(now)])))
        self.node.now_is(self.clock.now)
        return self.downwash()

    def downwash(self):
        """Returns the downward speed a core radius below the drone, minus that of the nodelet,
        which has no drone."""
        at = self.drone(self.clock.now).transform.translation
        below = [Point(at.x, at.y, at.z - 1.0)]
        air, rest = [b.sample(Header(), below, [self.clock.now]).velocities[0] for b in self.both]
        return rest.z - air.z

    def pieces(self):
        return len([p for p in self.node.get().field.primitives if p.name == 'rotor'])

    # Each of the two broadcasters reports once a second, and a refusal is in one report only.
    @staticmethod
    def warning(reports, text):
        """Waits for a status with this text and returns its message."""
        return reports.wait(lambda all: [s.message for m in all for s in m.status
                                         if text in s.message], text)[0]


if __name__ == '__main__':
    rospy.init_node('wind_clock_test')
    rostest.rosrun('vegetation_sim', 'wind_clock', WindClock)
