#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the meadow scenarios of the demo without rviz: the rolling stone (S2-29), the robot and people
on a hillside leave tracks, the mower cuts."""
import math
import pathlib
import signal
import subprocess
import threading
import unittest

import rosnode
import rospy
import rostest
from geometry_msgs.msg import Twist, Vector3, WrenchStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log as LogMessage
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import InteractiveMarkerFeedback, Marker, MarkerArray

from forest_rig import TickClock
from grass_rig import RATE, Meadow
from waiting import DEADLINE, wait_for
from watched_node import Log, publisher

ROOT = pathlib.Path(__file__).resolve().parents[3]
RADIUS = 0.45  # of the stone [m]
NODES = {'meadow': ['/stone', '/grass_field', '/wind_broadcaster'],
         'hills': ['/agent_crowd', '/driver', '/forest_animator', '/grass_field', '/robot', '/stone',
                   '/wind_broadcaster'],
         'mowing': ['/mower', '/grass_field', '/wind_broadcaster'],
         'meadow_robot': ['/robot', '/driver', '/grass_field', '/wind_broadcaster']}


class User:
    """Rolls the stone, and knows where it is."""

    def __init__(self, scenarios):
        self.scenarios, self.frames = scenarios, Log('/tf', TFMessage)
        self.errors = Log('/rosout', LogMessage)
        self.twists = publisher('/stone/cmd_vel', Twist)
        self.drags = publisher('/stone/feedback', InteractiveMarkerFeedback)
        wait_for(lambda: all(p.get_num_connections() for p in (self.twists, self.drags)), 'a stone')
        scenarios.run_until(self.places, 'the frame of the stone')
        scenarios.addCleanup(self.close)

    def places(self):
        """Returns all transforms of the stone."""
        return [t.transform for message in list(self.frames.messages) for t in message.transforms
                if t.child_frame_id == 'stone']

    def roll(self, ticks, x, y, turn=0.0):
        """Commands a velocity at each tick."""
        for _ in range(ticks):
            self.twists.publish(Twist(linear=Vector3(x, y, 0.0), angular=Vector3(0.0, 0.0, turn)))
            self.scenarios.pass_ticks(1)

    def drag(self, x, y, frame='map'):
        feedback = InteractiveMarkerFeedback(marker_name='stone', client_id='user',
                                             event_type=InteractiveMarkerFeedback.POSE_UPDATE)
        feedback.header.frame_id = frame
        feedback.pose.position.x, feedback.pose.position.y = x, y
        self.drags.publish(feedback)

    def wait_for_error(self, text):
        self.errors.wait(lambda all: [m for m in all if text in m.msg], text)

    def close(self):
        for end in (self.frames, self.errors):
            end.close()
        for end in (self.twists, self.drags):
            end.unregister()


def distance(place, way):
    """Returns the distance of a place from the nearest of a way [m]."""
    return min(math.hypot(place[0] - x, place[1] - y) for x, y in way)


def turn_between(a, b):
    """Returns the vector of the rotation from a to b [rad]."""
    c = (-a.x, -a.y, -a.z, a.w)
    x, y, z, w = (b.w * c[0] + b.x * c[3] + b.y * c[2] - b.z * c[1],
                  b.w * c[1] - b.x * c[2] + b.y * c[3] + b.z * c[0],
                  b.w * c[2] + b.x * c[1] - b.y * c[0] + b.z * c[3],
                  b.w * c[3] - b.x * c[0] - b.y * c[1] - b.z * c[2])
    size = math.sqrt(x * x + y * y + z * z)
    angle = 2.0 * math.atan2(size, w)
    return tuple(angle * part / size for part in (x, y, z))


class GrassScenarios(unittest.TestCase):
    clock = TickClock(1000 * RATE)

    def start(self, scenario):
        self.launch = subprocess.Popen(['roslaunch', 'vegetation_sim', 'demo.launch',
                                        'scenario:=' + scenario, 'rviz:=false'])
        self.addCleanup(self.stop)
        self.meadow = Meadow()
        self.meadow.wait_until_up('/wind')
        wait_for(lambda: set(NODES[scenario]) <= set(rosnode.get_node_names()), 'all nodes')
        self.clock.run(1, self.meadow)

    def stop(self):
        self.meadow.close()
        self.launch.send_signal(signal.SIGINT)
        self.launch.wait(DEADLINE)
        # The parameters of a launch outlive it.
        for node in ('grass_field', 'forest_animator', 'agent_crowd', 'wind_broadcaster'):
            if rospy.has_param('/' + node):
                rospy.delete_param('/' + node)

    def run_until(self, condition, what):
        pace = threading.Event()
        for _ in range(60 * RATE):
            if condition():
                return
            self.clock.run(1, self.meadow)
            pace.wait(0.5 / RATE)  # The other nodes are no faster than this.
        self.fail('60 s passed without ' + what)

    # S2-29: the grass lies flat on the path of the stone and stands beside it, while a tornado
    # blows.
    def test_a_stone_rolls_through_the_meadow(self):
        self.start('meadow')
        self.run_until(lambda: len(self.meadow.entered('stone')) > 5, 'a rolling stone')
        down = [e.tread.position for e in self.meadow.events.messages if e.tread.source == 'stone'][3:]
        samples = self.meadow.samples([(p.x, p.y) for p in down])
        self.assertGreater(min(s.tilt for s in samples), 1.2)
        way = (down[10].x - down[0].x, down[10].y - down[0].y)
        left = [1.2 * part / math.hypot(*way) for part in (-way[1], way[0])]
        beside = self.meadow.samples([(p.x + left[0], p.y + left[1]) for p in down[:10]])
        self.assertEqual(max(s.tilt for s in beside), 0.0)
        winds = [s.wind for s in self.meadow.samples([(4.0 + x, 12.0 + y) for x in range(-10, 11, 2)
                                                      for y in range(-10, 11, 2)])]
        self.assertGreater(max(math.hypot(w.x, w.y) for w in winds), 8.0)
        self.assertGreater(len({round(s.height, 2) for s in samples}), 5)
        self.assertEqual(self.meadow.diagnostics()['Jumps of sources'], 0)

    # rviz draws a mesh, which can have a texture and casts a shadow.
    def test_the_stone_is_a_mesh_of_the_package(self):
        self.start('meadow')
        markers = Log('/stone/markers', MarkerArray)
        self.addCleanup(markers.close)
        stone = markers.wait(lambda all: all, 'the stone')[0].markers[0]
        self.assertEqual(stone.type, Marker.MESH_RESOURCE)
        self.assertTrue(stone.mesh_use_embedded_materials)
        mesh = ROOT / stone.mesh_resource.replace('package://vegetation_sim/', '')
        reach = max(math.hypot(*map(float, line.split()[1:])) for line in mesh.read_text().split('\n')
                    if line.startswith('v '))
        self.assertAlmostEqual(stone.scale.x * reach, RADIUS, delta=0.1 * RADIUS)

    # S2-29: a user rolls the stone by twists and by its marker. Grass is down on its way and nowhere
    # else.
    def test_a_user_rolls_the_stone(self):
        self.start('meadow')
        user = User(self)
        user.roll(5, -1.5, 0.5)
        first = user.places()[-1]
        user.roll(40, -1.5, 0.5)
        last = user.places()[-1]
        way = (last.translation.x - first.translation.x, last.translation.y - first.translation.y)
        self.assertGreater(math.hypot(*way), 0.8)
        self.assertAlmostEqual(way[1] / way[0], -0.5 / 1.5, places=6)
        turn = turn_between(first.rotation, last.rotation)
        self.assertAlmostEqual(turn[0], -way[1] / RADIUS, places=6)
        self.assertAlmostEqual(turn[1], way[0] / RADIUS, places=6)
        self.assertAlmostEqual(turn[2], 0.0, places=6)
        self.pass_ticks(RATE)  # The last command expires.
        stands = user.places()[-1]
        self.pass_ticks(RATE)
        self.assertEqual(user.places()[-1].translation, stands.translation)
        to = (stands.translation.x - 1.0, stands.translation.y - 4.0)
        user.drag(*to)
        self.run_until(lambda: distance(to, [(t.translation.x, t.translation.y)
                                             for t in user.places()]) < 1e-6, 'a dragged stone')
        self.pass_ticks(5)
        way = [(t.translation.x, t.translation.y) for t in user.places()]
        self.assertGreater(min(s.tilt for s in self.meadow.samples(way[::10])), 1.2)
        x, y = to
        beside = [place for place in [(x + 0.5 * i, y + 0.5 * j) for i in range(-8, 9)
                                      for j in range(-8, 17)] if distance(place, way) > 1.3]
        self.assertGreater(len(beside), 100)
        self.assertEqual(max(s.tilt for s in self.meadow.samples(beside)), 0.0)

    def test_the_stone_rejects_bad_commands(self):
        self.start('meadow')
        user = User(self)
        user.roll(RATE, 0.0, 0.0)
        before = user.places()[-1].translation
        user.roll(1, float('nan'), 0.0)
        user.wait_for_error('stone/cmd_vel: linear.x = nan m/s is not within -3 to 3 m/s')
        user.roll(1, 0.0, -3.5)
        user.wait_for_error('stone/cmd_vel: linear.y = -3.5 m/s is not within -3 to 3 m/s')
        user.roll(1, 2.9, 2.9)
        user.wait_for_error('stone/cmd_vel: speed = 4.10122 m/s is not within 0 to 3 m/s')
        user.roll(1, 0.0, 0.0, float('inf'))
        user.wait_for_error('stone/cmd_vel: angular.z = inf rad/s is not within -3 to 3 rad/s')
        user.drag(1.0, float('nan'))
        user.wait_for_error('stone/feedback: position.y = nan m is not within -100000 to 100000 m')
        user.drag(1.0, 0.0, 'camera')
        user.wait_for_error("stone/feedback: frame 'camera' is not the world frame 'map'")
        self.pass_ticks(RATE)
        self.assertEqual(user.places()[-1].translation, before)

    def pass_ticks(self, count):
        end = self.clock.tick + count
        self.run_until(lambda: self.clock.tick >= end, 'time')

    def test_a_mower_cuts_a_meadow(self):
        self.start('mowing')
        self.run_until(lambda: self.meadow.at(-3.0, -4.5).swath > 0.0, 'a mower that cuts')
        cut, beside = self.meadow.samples([(-3.0, -4.5), (-3.0, 2.5)])
        self.assertTrue(cut.cut)
        self.assertAlmostEqual(cut.height, 0.06, places=6)
        self.assertFalse(beside.cut)

    # S2-36: the scene of paper 2.
    def test_people_tread_a_hillside_between_trees(self):
        self.start('hills')
        truth = Log('/base_pose_ground_truth', Odometry)
        self.addCleanup(truth.close)
        self.run_until(lambda: len({t.source for t in self.treads()}) > 30, 'people')
        self.run_until(lambda: len(self.treads()) > 2000, 'people who walk')
        down = [t.position for t in self.treads()]
        self.clock.run(1, self.meadow)
        self.assertGreater(max(p.z for p in down) - min(p.z for p in down), 6.0)
        samples = self.meadow.samples([(p.x, p.y) for p in down])
        self.assertLess(max(abs(s.position.z - p.z) for s, p in zip(samples, down)), 1e-6)
        self.assertGreater(min(s.tilt for s in samples if s.inside), 1.0)
        user = User(self)
        user.roll(2 * RATE, 1.0, 0.0, 0.5)
        self.check_rest([t.translation for t in user.places()])
        self.check_robot([m.pose.pose.position for m in truth.messages])

    def check_robot(self, places):
        """Checks that the robot has driven over the slope, on which it stands and treads."""
        places = places[5::20]  # At first it does not know the slope.
        self.assertGreater(math.hypot(places[-1].x - places[0].x, places[-1].y - places[0].y), 1.0)
        heights = [s.position.z for s in self.meadow.samples([(p.x, p.y) for p in places])]
        self.assertGreater(max(heights) - min(heights), 0.1)
        for place, height in zip(places, heights):
            self.assertAlmostEqual(place.z, height, delta=0.05)
        wheel = [e.tread.position for e in self.meadow.events.messages
                 if e.tread.source == 'left_wheel_contact'][5:-2]
        self.assertGreater(min(s.tilt for s in self.meadow.samples([(p.x, p.y) for p in wheel])), 1.0)

    def check_rest(self, places):
        """Checks that a stone touches the slope that it has climbed or descended, and treads it."""
        self.assertGreater(abs(places[-1].z - places[0].z), 0.1)
        step = 0.02
        for place in places[::10]:
            here, east, north = (s.position.z for s in self.meadow.samples(
                [(place.x, place.y), (place.x + step, place.y), (place.x, place.y + step)]))
            slope = math.hypot(east - here, north - here) / step
            self.assertAlmostEqual((place.z - here) / math.hypot(1.0, slope), RADIUS, delta=0.01)
        self.assertGreater(min(s.tilt for s in self.meadow.samples(
            [(place.x, place.y) for place in places[:-10:10]])), 1.0)

    def treads(self):
        return [e.tread for e in self.meadow.events.messages if e.tread.source.startswith('walker_')]

    def test_a_robot_leaves_the_tracks_of_its_wheels(self):
        self.start('meadow_robot')
        odom, wrenches = Log('/odom', Odometry), Log('/grass/wrenches', WrenchStamped)
        wait_for(lambda: odom.connected() and wrenches.connected(), 'odometry and wrenches')
        self.run_until(lambda: len(self.meadow.entered('left_wheel_contact')) > 3, 'a robot that drives')
        for side in ('left_wheel_contact', 'right_wheel_contact'):
            way = [e.tread.position for e in self.meadow.events.messages if e.tread.source == side][5:-2]
            samples = self.meadow.samples([(p.x, p.y) for p in way])
            self.assertGreater(min(s.tilt for s in samples), 1.0)
        left, right = (self.meadow.entered(side)[0] for side in ('left_wheel_contact', 'right_wheel_contact'))
        self.assertLessEqual(abs(left[0] - right[0]) + abs(left[1] - right[1]), 2)
        pulls = wrenches.wait(lambda all: [w.wrench.force.x for w in all
                                           if w.header.frame_id == 'left_wheel_contact'], 'a pull')
        self.assertLess(min(pulls), -0.5)
        self.assertLessEqual(max(pulls), 1e-6)
        self.assertGreater(odom.messages[-1].twist.twist.linear.x, 0.8)
        odom.close()
        wrenches.close()


if __name__ == '__main__':
    rospy.init_node('grass_scenarios_test')
    rostest.rosrun('vegetation_sim', 'grass_scenarios', GrassScenarios)
