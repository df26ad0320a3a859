#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests sources that grass_field reads from tf frames and odometry with parameters only (N4), the
drag on them (N3), the downwash below a hovering source, and the wake of a car (N11)."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import TransformStamped, WrenchStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import GrassForces, TreadEvent, WindPrimitive
from vegetation_sim.srv import SetWindPrimitive

from forest_rig import TickClock
from grass_rig import FULL, RATE, Feet, Meadow, step, time_of
from waiting import DEADLINE, wait_for
from watched_node import Log, publisher, wait_for_readers


class GrassSources(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.clock = TickClock(1000 * RATE)
        cls.grass.wait_until_up('/wind')
        cls.tf = publisher('/tf', TFMessage)
        cls.odom = publisher('/odom', Odometry)
        wait_for_readers('/tf', cls.grass.process)
        wait_for_readers('/odom', cls.grass.process)
        cls.wrenches = Log('/grass/wrenches', WrenchStamped)
        cls.forces = Log('/grass/forces', GrassForces)
        wait_for(cls.wrenches.connected, 'wrenches')
        wait_for(cls.forces.connected, 'forces')
        cls.clock.run(1, cls.grass)

    def frame(self, name, x, y, z, yaw=0.0):
        out = TransformStamped(child_frame_id=name)
        out.header.frame_id, out.header.stamp = 'map', time_of(self.clock.tick + 1)
        at = out.transform.translation
        at.x, at.y, at.z = x, y, z
        out.transform.rotation.w, out.transform.rotation.z = math.cos(yaw / 2), math.sin(yaw / 2)
        return out

    def fly(self, ticks, *frames_at):
        """Publishes one frame per function and tick; a function gets the completed share of the
        path."""
        for i in range(ticks + 1):
            self.move(*(f(i / ticks) for f in frames_at))
            self.clock.run(1, self.grass)

    def move(self, *frames):
        transforms = [self.frame(*frame) for frame in frames]
        self.tf.publish(TFMessage(transforms))
        self.grass.settle_frames(transforms)

    def last_wrench(self, frame):
        stamp = time_of(self.clock.tick)
        return self.wrenches.wait(lambda all: next(
            (w.wrench for w in reversed(all) if w.header.frame_id == frame and
             w.header.stamp == stamp), None), 'the drag on ' + frame)

    # N4: each track is as wide as its wheel, and the grass between the wheels stands.
    def test_wheels_leave_two_tracks_of_their_width(self):
        self.fly(3 * RATE, lambda s: ('wheel_left', -6.0 + 4.0 * s, 3.0, 0.1),
                 lambda s: ('wheel_right', -6.0 + 4.0 * s, 2.0, 0.1))
        for y, low, high in ((3.0, 1.4, 1.6), (3.12, 1.4, 1.6), (2.0, 1.4, 1.6), (1.88, 1.4, 1.6),
                             (2.5, 0.0, 0.0), (3.5, 0.0, 0.0), (3.3, 0.0, 0.6)):
            self.assertTrue(low <= self.grass.at(-4.0, y).tilt <= high, (y, self.grass.at(-4.0, y).tilt))
        # Grass left of the track's middle is pressed to the left and forward, and on the right to
        # the right.
        self.assertGreater(self.grass.at(-4.0, 3.1).direction.y, 0.6)
        self.assertLess(self.grass.at(-4.0, 2.9).direction.y, -0.6)
        self.assertGreater(self.grass.at(-4.0, 2.9).direction.x, 0.6)

    # A bar of 0.1 m that moves by 0.3 m a tick leaves no gap; above its gate or off it cuts nothing.
    def test_a_cutter_mows_a_lane(self):
        self.fly(20, lambda s: ('blade', -16.0 + 6.0 * s, -17.0, 0.1))
        lane = self.grass.samples([(-16.0 + 0.05 * i, -17.0 + side) for i in range(120)
                                   for side in (-0.45, 0.0, 0.45)])
        self.assertEqual({s.cut for s in lane}, {True})
        self.assertAlmostEqual(max(s.height for s in lane), 0.07, places=6)
        self.assertEqual({s.cut for s in self.grass.samples([(-13.0, -16.4), (-13.0, -17.6)])}, {False})
        self.assertGreater(self.grass.at(-13.0, -17.0).swath, 0.0)
        self.assertEqual(self.grass.at(-13.0, -16.6).swath, 0.0)
        self.fly(20, lambda s: ('blade', -9.0 + 6.0 * s, -17.0, 0.3))
        self.assertFalse(self.grass.at(-6.0, -17.0).cut)
        switch = rospy.ServiceProxy('/grass_field/cutting', SetBool)
        self.assertTrue(switch(False).success)
        self.fly(20, lambda s: ('blade', -9.0 + 6.0 * s, -17.0, 0.1))
        self.assertFalse(self.grass.at(-6.0, -17.0).cut)
        self.assertTrue(switch(True).success)
        self.fly(20, lambda s: ('blade', -9.0 + 6.0 * s, -17.0, 0.1))
        self.assertTrue(self.grass.at(-6.0, -17.0).cut)

    # 3 m a tick are more than top_speed, and less than longest_stroke.
    def test_a_cutter_that_jumps_cuts_only_where_it_lands(self):
        self.fly(4, lambda s: ('blade', -15.0 + 12.0 * s, -19.0, 0.1))
        landed = self.grass.samples([(-15.0 + 3.0 * i, -19.0) for i in range(5)])
        self.assertEqual({s.cut for s in landed}, {True})
        self.assertFalse(any(s.cut for s in self.grass.samples(
            [(-13.5 + 3.0 * i, -19.0) for i in range(4)])))

    def test_an_offset_and_a_gate_of_its_own(self):
        self.fly(RATE, lambda s: ('mower', 2.0, 8.0 + s, 0.25, math.pi / 2))
        # The offset is 0.5 m ahead and 0.05 m up.
        self.assertGreater(self.grass.at(2.4, 9.0).tilt, 1.4)
        self.assertEqual(self.grass.at(2.0, 6.5).tilt, 0.0)
        self.fly(RATE, lambda s: ('mower', 6.0, 8.0 + s, 0.35, math.pi / 2))
        self.assertEqual(self.grass.at(6.0, 9.0).tilt, 0.0)

    # N3: drag points against the motion in the axes of the frame, grows with density and speed, and
    # is zero above the gate.
    def test_drag_on_a_wheel(self):
        def pull(x, speed, yaw=0.0, z=0.1):
            self.grass.clear(all=True)
            self.fly(RATE // 2, lambda s: ('wheel_left', x + 0.5 * speed * s, -8.0, z, yaw))
            return self.last_wrench('wheel_left').force
        slow, fast, dense = pull(-12.0, 1.0), pull(-12.0, 2.0), pull(8.0, 1.0)
        density = 800.0 * 128 / 255
        self.assertAlmostEqual(slow.x, -0.3 * 0.2 * density * 0.3, delta=0.05)
        self.assertAlmostEqual(fast.x / slow.x, 2.0, delta=0.05)
        self.assertAlmostEqual(dense.x / slow.x, 255 / 128, delta=0.05)
        turned = pull(-12.0, 1.0, math.pi / 2)
        self.assertAlmostEqual(turned.y, -slow.x, delta=0.05)
        self.assertAlmostEqual(turned.x, 0.0, delta=1e-6)
        self.assertEqual(pull(-12.0, 1.0, z=0.5).x, 0.0)
        self.assertEqual(pull(30.0, 1.0).x, 0.0)

    def test_odometry_treads_and_sets_the_speed_of_the_drag(self):
        message = Odometry(child_frame_id='base_link')
        message.header.frame_id = 'map'
        message.pose.pose.orientation.w = 1.0
        message.twist.twist.linear.x = 3.0
        for i in range(RATE + 1):
            message.header.stamp = time_of(self.clock.tick + 1)
            message.pose.pose.position.x, message.pose.pose.position.y = 10.0 + 3.0 * i / RATE, -4.0
            self.odom.publish(message)
            self.move(('base_link', message.pose.pose.position.x, -4.0, 0.0))
            self.clock.run(1, self.grass)
        self.assertGreater(self.grass.at(11.5, -4.1).tilt, 1.4)
        drag = -0.4 * 0.2 * 800.0 * 0.3 * 3.0
        self.assertAlmostEqual(self.last_wrench('base_link').force.x, drag, delta=0.5)
        forces = self.forces.wait_for_stamp(time_of(self.clock.tick))
        mine = next(f for f in forces.forces if f.frame == 'base_link')
        self.assertEqual((forces.header.frame_id, mine.source), ('map', 'cart'))
        self.assertAlmostEqual(mine.force.x, drag, delta=0.5)
        self.assertAlmostEqual(mine.point.x, message.pose.pose.position.x, delta=0.2)

    # An orientation that is not normalised would stretch the offset of the source.
    def test_odometry_without_a_unit_quaternion_is_refused_by_name(self):
        message = Odometry(child_frame_id='base_link')
        message.header.frame_id = 'map'
        message.pose.pose.orientation.w = 8.0
        message.pose.pose.position.x, message.pose.pose.position.y = 10.0, -12.0

        def refused():
            message.header.stamp = time_of(self.clock.tick + 1)
            self.odom.publish(message)
            self.grass.settle()
            self.clock.run(1, self.grass)
            return self.grass.diagnostics()['Inputs refused'] > before
        before = self.grass.diagnostics()['Inputs refused']
        wait_for(refused, 'a refusal')
        self.assertEqual(self.grass.at(10.0, -12.0).tilt, 0.0)

    def test_bad_odometry_is_refused_although_good_one_follows_it(self):
        message = Odometry(child_frame_id='base_link')
        message.header.frame_id, message.header.stamp = 'map', time_of(self.clock.tick + 1)
        before = self.grass.diagnostics()['Inputs refused']
        for w in (8.0, 1.0):
            message.pose.pose.orientation.w = w
            self.odom.publish(message)
        self.grass.settle()
        self.clock.run(1, self.grass)
        self.assertEqual(self.grass.diagnostics()['Inputs refused'], before + 1)

    # N4: a source whose frame is silent is removed. When the frame returns, the source starts
    # there.
    def test_a_silent_frame_has_left(self):
        self.fly(RATE // 2, lambda s: ('wheel_right', -14.0 + 0.5 * s, 12.0, 0.0))
        self.clock.run(2 * RATE, self.grass)
        self.assertGreaterEqual(self.grass.diagnostics()['Sources without a position'], 1)
        self.grass.events.wait(
            lambda all: any(e.tread.source == 'wheel_right' and e.tread.action == TreadEvent.LIFT
                            for e in all), 'a wheel that lifts')
        self.fly(RATE // 2, lambda s: ('wheel_right', -12.0 + 0.5 * s, 12.0, 0.0))
        self.assertEqual(self.grass.at(-12.8, 12.0).tilt, 0.0)
        self.assertGreater(self.grass.at(-11.8, 12.0).tilt, 1.4)

    # N11: grass below a hovering drone bends outward in all directions, follows the drone and keeps
    # no track.
    def test_a_hovering_drone_bends_grass_outward_and_leaves_no_track(self):
        blast = WindPrimitive(name='rotor', kind=WindPrimitive.BLAST, radius=5.0, core_radius=0.8,
                              speed=15.0, fade_in=0.2, fade_out=0.2, attached_frame='drone')
        rospy.wait_for_service('/wind_broadcaster/set_primitive', DEADLINE)
        answer = rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(blast)
        self.assertTrue(answer.success, answer.message)
        wait_for_readers('/tf', '/wind_broadcaster')

        def hover(x):
            self.fly(3 * RATE, lambda s: ('drone', x, 14.0, 1.0))
            for angle in (0.0, 1.2, 2.5, 3.9, 5.1):
                out = (math.cos(angle), math.sin(angle))
                bend = self.grass.at(x + 1.2 * out[0], 14.0 + 1.2 * out[1]).bend
                along = bend.x * out[0] + bend.y * out[1]
                across = -bend.x * out[1] + bend.y * out[0]
                self.assertGreater(along, 0.02)
                self.assertLess(abs(across), 0.2 * along)
            self.assertEqual(self.grass.at(x, 14.0).tilt, 0.0)
        hover(-4.0)
        self.fly(3 * RATE, lambda s: ('drone', -4.0 + 10.0 * s, 14.0, 1.0))
        hover(6.0)
        left = self.grass.at(-4.0 + 1.2, 14.0).bend
        self.assertLess(math.hypot(left.x, left.y), 1e-3)
        self.assertEqual(self.grass.at(1.0, 14.0).tilt, 0.0)
        # A drone that lands treads the grass.
        self.fly(RATE, lambda s: ('drone', 6.0, 14.0, 1.0 - s))
        self.assertGreater(self.grass.at(6.0, 14.2).tilt, 1.4)

    # N11: behind a moving car grass bends along its motion, the less the farther behind; ahead of it
    # and aside it stands.
    def test_the_wake_of_a_car_bends_grass_behind_it(self):
        wake = WindPrimitive(name='slipstream', kind=WindPrimitive.WAKE, radius=1.5, inflow=0.5,
                             plateau_length=8.0, decay_length=4.0, fade_in=0.2, fade_out=0.2,
                             attached_frame='car')
        rospy.wait_for_service('/wind_broadcaster/set_primitive', DEADLINE)
        answer = rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(wake)
        self.assertTrue(answer.success, answer.message)
        wait_for_readers('/tf', '/wind_broadcaster')
        self.fly(2 * RATE, lambda s: ('car', -12.0 + 16.0 * s, 16.0, 0.5))
        before = math.inf
        for behind in (1.0, 3.0, 6.0):
            bend = self.grass.at(4.0 - behind, 16.0).bend
            self.assertGreater(bend.x, 0.02)
            self.assertLess(bend.x, before)
            self.assertLess(abs(bend.y), 0.05 * bend.x)
            before = bend.x
        for x, y in ((8.0, 16.0), (12.0, 16.0), (1.0, 8.0), (-12.0, 16.0)):
            bend = self.grass.at(x, y).bend
            self.assertLess(math.hypot(bend.x, bend.y), 1e-3, (x, y))
        self.assertEqual(self.grass.at(0.0, 16.0).tilt, 0.0)

    # A tread on the topic may be in any known tf frame, and body_frame receives its drag.
    def test_a_tread_in_another_frame(self):
        self.fly(3, lambda s: ('cart_base', 10.0, 10.0, 0.0, math.pi / 2))
        feet = Feet(self.grass)
        for i in range(5):
            message = step('blade', 0.1 * i, 0.0, body_frame='cart_base')
            message.header.frame_id = 'cart_base'
            feet.send(message)
            self.clock.run(1, self.grass)
        self.assertGreater(self.grass.at(10.0, 10.2).tilt, 1.4)
        self.assertLess(self.last_wrench('cart_base').force.x, -10.0)
        feet.close()


if __name__ == '__main__':
    rospy.init_node('grass_sources_test')
    rostest.rosrun('vegetation_sim', 'grass_sources', GrassSources)
