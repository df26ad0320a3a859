#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""forest_animator rejects bad requests and messages with an error that names the field. They have
no effect."""
import copy
import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, PointStamped, TransformStamped, Vector3
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ForestEvent, WindField
from vegetation_sim.srv import FindTrees

from forest_rig import RATE, Animator, SensorClient, TickClock, ViewerClient, time_of
from waiting import wait_for
from watched_node import Log, publisher

NAN, INF = float('nan'), float('inf')
TREES = 17
MOST_SENSORS = 32
MOST_AHEAD = 5000  # inputs of one client that may wait for later stamps
FAR = rospy.Time(4102444800)  # in the year 2100
DOWN = dict(direction=Vector3(0.0, 0.0, -1.0), tolerance=0.1)


class ForestRequests(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.clock = TickClock(1000 * RATE)
        cls.clock.begin(cls.forest)
        cls.wind = publisher('/wind', WindField)
        cls.viewer, cls.sensor = ViewerClient(), SensorClient()
        cls.find_trees = rospy.ServiceProxy('/forest_animator/find_trees', FindTrees)
        cls.diagnostics = Log('/diagnostics', DiagnosticArray)
        wait_for(lambda: cls.wind.get_num_connections() > 0, 'readers of the wind')

    # Without a sensor the hash stays the same unless an input was applied.
    def setUp(self):
        self.clock.run(5 * RATE, self.forest)
        self.hash = self.forest.state.messages[-1].hash
        self.events = len(self.forest.events.messages)

    def expect_unchanged(self):
        self.clock.run(3, self.forest)
        self.assertEqual(self.forest.state.messages[-1].hash, self.hash)
        self.assertEqual(len(self.forest.events.messages), self.events)

    def expect_refusal(self, *texts):
        """Waits for diagnostics with these texts."""
        def matches(status):
            message = status.message.replace('-nan', 'nan')
            return all(text in message for text in texts)
        self.diagnostics.wait(
            lambda all: any(matches(status) for m in all for status in m.status), texts)

    def test_get_tree_refuses_an_unknown_tree(self):
        for tree in (TREES, 2 ** 32 - 1):
            self.assertEqual(self.forest.refusal(tree=tree),
                             'tree = %d is unknown; there are %d, from 0' % (tree, TREES))
        self.expect_unchanged()

    def test_pick_rejects_invalid_rays(self):
        cases = [
            (dict(DOWN, origin=Point(NAN, 0, 9)), 'origin.x = nan m is not finite'),
            (dict(DOWN, origin=Point(0, 1e8, 9)), 'origin.y = 1e+08 m is outside -1e+07 to 1e+07'),
            (dict(direction=Vector3(0, INF, 0)), 'direction.y = inf is not finite'),
            (dict(), 'direction has no length'),
            (dict(DOWN, tolerance=-0.1), 'tolerance = -0.1 m is outside 0 to 10 m'),
            (dict(DOWN, tolerance=1e9), 'tolerance = 1e+09 m is outside 0 to 10 m'),
            (dict(DOWN, tolerance=NAN), 'tolerance = nan m is not finite'),
            (dict(DOWN, header=Header(frame_id='nowhere')), "frame_id = 'nowhere' is not known in 'map'"),
            (dict(DOWN, origin=Point(0, 0, -9)), 'the ray meets no branch'),
        ]
        for request, text in cases:
            with self.subTest(text=text):
                answer = self.forest.pick(**request)
                self.assertFalse(answer.success)
                self.assertIn(text, answer.message.replace('-nan', 'nan'))
        all_at_once = self.forest.pick(tolerance=-1.0, origin=Point(INF, 0, NAN)).message
        for name in ('origin.x', 'origin.z', 'tolerance'):
            self.assertIn(name, all_at_once)
        self.expect_unchanged()

    # S1-02: a ray in the world or in another frame selects a branch.
    def test_pick_finds_a_branch(self):
        root = self.forest.tree(0).transforms.poses[0].position
        straight = self.forest.pick(origin=Point(root.x, root.y, 90.0), **DOWN)
        self.assertTrue(straight.success, straight.message)
        self.assertEqual(straight.message, 'tree_0/branch_%d' % straight.branch)
        self.assertGreater(straight.point.z, root.z)
        frame = TransformStamped(child_frame_id='tool')
        frame.header.frame_id = 'map'
        frame.transform.translation.x, frame.transform.rotation.w = root.x, 1.0
        frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        frames.publish([frame])
        request = dict(DOWN, origin=Point(0.0, root.y, 90.0), header=Header(frame_id='tool'))
        in_tool = wait_for(lambda: (lambda a: a.success and a)(self.forest.pick(**request)),
                           'the frame tool')
        self.assertEqual((in_tool.tree, in_tool.branch, in_tool.point),
                         (straight.tree, straight.branch, straight.point))

    def find(self, **request):
        """Returns the trees that the service finds, and their number on all pages."""
        answer = self.find_trees(**request)
        self.assertTrue(answer.success, answer.message)
        return answer.trees, answer.total

    def test_find_trees_lists_pages_of_all_trees(self):
        pages = [self.find(all=True, offset=i, limit=5) for i in range(0, TREES + 5, 5)]
        found = [tree for trees, _ in pages for tree in trees]
        self.assertEqual([total for _, total in pages], [TREES] * 5)
        self.assertEqual([tree.id for tree in found], list(range(TREES)))
        for tree in found:
            known = self.forest.tree(tree.id)
            self.assertEqual((tree.height, tree.species), (known.height, known.species))
            self.assertEqual(tree.position, known.transforms.poses[0].position)

    def test_find_trees_finds_those_within_a_radius_nearest_first(self):
        all_trees, _ = self.find(all=True, limit=100)
        centre = all_trees[3].position

        def distance(tree):
            return math.hypot(tree.position.x - centre.x, tree.position.y - centre.y)
        expected = sorted(all_trees, key=distance)
        radius = 0.5 * (distance(expected[4]) + distance(expected[5]))
        request = dict(centre=PointStamped(point=centre), radius=radius)
        self.assertEqual(self.find(limit=100, **request), (expected[:5], 5))
        self.assertEqual(self.find(limit=2, offset=2, **request), (expected[2:4], 5))
        self.assertEqual(self.find(limit=1, offset=2 ** 32 - 1, **request), ([], 5))

    def test_find_trees_rejects_bad_requests(self):
        nowhere = PointStamped(header=Header(frame_id='nowhere'))
        cases = [
            (dict(all=True), 'limit = 0 is outside 1 to 100'),
            (dict(all=True, limit=101), 'limit = 101 is outside 1 to 100'),
            (dict(limit=1, radius=-1.0), 'radius = -1 m is outside 0 to 1e+07 m'),
            (dict(limit=1, radius=NAN), 'radius = nan m is not finite'),
            (dict(limit=1, centre=PointStamped(point=Point(INF, 0, 0))), 'centre.x = inf m is not finite'),
            (dict(limit=1, centre=nowhere), "frame_id = 'nowhere' is not known in 'map'"),
        ]
        for request, text in cases:
            with self.subTest(text=text):
                answer = self.find_trees(**request)
                self.assertFalse(answer.success)
                self.assertIn(text, answer.message.replace('-nan', 'nan'))

    def test_set_tf_rejects_requests_and_keeps_the_frames(self):
        self.assertEqual(self.forest.set_tf(1, [4, 5], True).frames, 2)
        cases = [
            ((TREES, [0], True), 'tree = 17 is unknown; there are 17, from 0'),
            ((1, [6, 99999], True), 'branches: 99999 is unknown; tree 1 has '),
            ((1, [99999], False), 'branches: 99999 is unknown'),
            ((1, list(range(6, 15)), True), 'frames = 11 would pass the budget of 10'),
            ((2, 'all', True), 'would pass the budget of 10'),
            ((2, [], True), 'branches has 0 entries; all = true stands for every branch'),
        ]
        for request, text in cases:
            with self.subTest(text=text):
                answer = self.forest.set_tf(*request)
                self.assertFalse(answer.success)
                self.assertIn(text, answer.message)
                self.assertEqual(answer.frames, 2)
        self.assertEqual(self.forest.set_tf(1, 'all', False).frames, 0)
        self.expect_unchanged()

    def test_a_bad_viewer_is_refused(self):
        good = self.viewer.message
        cases = [
            (dict(field_of_view=0.0), 'viewer: field_of_view = 0 rad is outside 0.01 to 3.1 rad'),
            (dict(field_of_view=4.0), 'viewer: field_of_view = 4 rad is outside'),
            (dict(height=0), 'viewer: height = 0 pixel is outside 1 to 100000 pixel'),
            (dict(header=Header(frame_id='nowhere')), "viewer: frame_id = 'nowhere' is not known"),
        ]
        for fields, text in cases:
            with self.subTest(text=text):
                message = copy.deepcopy(good)
                for name, value in fields.items():
                    setattr(message, name, value)
                self.viewer.send(message, self.forest)
                self.expect_refusal('refused input', text)
        message = copy.deepcopy(good)
        message.field_of_view = NAN
        message.pose.position.y = NAN
        message.pose.orientation.w = 2.0
        message.id = 'x' * 300
        self.viewer.send(message, self.forest)
        self.expect_refusal('pose.position.y', 'pose.orientation, its norm, = 2 is outside 0.99',
                            'field_of_view', 'id is longer than 256 characters')
        message = copy.deepcopy(good)
        message.field_of_view = -1.0
        message.pose.orientation.x = NAN
        self.viewer.send(message, self.forest)
        self.expect_refusal('field_of_view = -1 rad', 'pose.orientation, its norm,', 'not finite')
        self.expect_unchanged()
        self.viewer.move_to(-15, 0, 5, self.forest)
        self.expect_unchanged()  # A good viewer does not affect the state of the world either.
        self.assertNotEqual(self.forest.view_level(0), self.forest.level(0))

    def test_a_bad_sensor_is_refused(self):
        message = copy.deepcopy(self.sensor.message)
        message.position.z = NAN
        message.range = -1.0
        message.tolerance = 0.0
        message.id = 'x' * 300
        self.sensor.send(message, self.forest)
        self.expect_refusal('refused input', 'sensor: position', 'range = -1 m is outside 0 to 1000 m',
                            'tolerance = 0 m is outside 0.0001 to 10 m',
                            'id is longer than 256 characters')
        message = copy.deepcopy(self.sensor.message)
        message.header.frame_id = 'nowhere'
        self.sensor.send(message, self.forest)
        self.expect_refusal("frame_id = 'nowhere' is not known")
        self.expect_unchanged()
        level = self.forest.level(0)
        self.sensor.move_to(-15, 0, 5, self.forest)
        self.clock.run(3, self.forest)
        self.assertNotEqual(self.forest.level(0), level)
        # The sensor changes what is perceived, not the world.
        self.assertEqual(self.forest.state.messages[-1].hash, self.hash)

    # Sensors that never become due must not fill the queue.
    def test_sensors_of_a_far_stamp_are_refused(self):
        message = copy.deepcopy(self.sensor.message)
        message.header.stamp = FAR
        for i in range(MOST_AHEAD):
            message.id = 'far %d' % i
            self.sensor.send(message, *([self.forest] if i % 50 == 49 else []))
        self.expect_refusal('sensor: stamp = %d.000 s is ' % FAR.secs, 'ahead, allowed are 60 s')
        message.id, message.header.stamp = 'near', time_of(self.clock.tick + 6)
        self.sensor.send(message, self.forest)
        self.clock.run(6, self.forest)
        events = self.forest.events.messages[self.events:]
        self.assertEqual([(e.header.stamp, e.kind, e.sensor.id) for e in events],
                         [(message.header.stamp, ForestEvent.SENSOR, 'near')])

    def test_a_bad_wind_is_refused(self):
        log = Log('/wind', WindField)
        good = log.wait(lambda all: all and all[-1], 'the wind')
        log.close()
        frame = copy.deepcopy(good)
        frame.header.frame_id = 'odom'
        nan = copy.deepcopy(good)
        nan.primitives[1].velocity.x = NAN
        nan.primitives[2].radius = -3.0
        other = copy.deepcopy(good)
        other.seed += 1
        for message, texts in [
                (frame, ["wind: frame_id = 'odom', allowed is the world frame of this node, 'map'"]),
                (nan, ['velocity.x', 'not finite', 'radius = -3 m is outside 0.01 to 100000 m']),
                (other, ['wind: hash = %d is not ' % good.hash])]:
            self.wind.publish(message)
            self.forest.settle()
            self.expect_refusal('refused input', *texts)
        self.expect_unchanged()

    # dynamic_reconfigure clamps values to the range. A NaN passes its clamp, and the node rejects
    # it.
    def test_settings_that_are_no_numbers_are_refused(self):
        server = Client('/forest_animator', timeout=30)
        before = server.get_configuration()
        shown = server.update_configuration({'tolerance': NAN, 'size': NAN})
        self.assertEqual(shown, before)
        self.expect_refusal('settings: tolerance', 'size', 'is not finite')
        self.expect_unchanged()
        server.close()

    def test_floods_are_weathered(self):
        log = Log('/wind', WindField)
        wind = log.wait(lambda all: all and all[-1], 'the wind')
        log.close()
        for _ in range(1000):
            self.wind.publish(wind)
        flood = copy.deepcopy(self.sensor.message)
        flood.position.x = -15.0
        level = self.forest.level(0)
        for i in range(1000):
            flood.id = 'flood' if i % 2 else 'flood %d' % i
            self.sensor.send(flood)
        self.forest.settle()
        self.clock.run(RATE, self.forest)
        events = self.forest.events.messages[self.events:]
        words = [(e.header.stamp, e.kind, e.sensor.id) for e in events]
        self.assertEqual(len(words), len(set(words)), 'more than the last word at a tick')
        sensors = {e.sensor.id for e in events if e.kind == ForestEvent.SENSOR}
        self.assertLessEqual(len(sensors), MOST_SENSORS)
        if len(sensors) == MOST_SENSORS:
            self.expect_refusal('is one more than the %d allowed at once' % MOST_SENSORS)
        self.assertEqual(self.forest.state.messages[-1].hash, self.hash)
        # Sensors from messages that were still in a socket may be active for a while.
        self.clock.run_until(lambda: self.forest.level(0) == level, 'the forest as it was before',
                             self.forest)


if __name__ == '__main__':
    rospy.init_node('forest_requests_test')
    rostest.rosrun('vegetation_sim', 'forest_requests', ForestRequests)
