#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests content, rate and size of the messages of forest_animator for 256 trees in wind."""
import io
import unittest

import rospy
import rostest
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import BranchTransforms
from visualization_msgs.msg import Marker, MarkerArray

from forest_rig import RATE, Animator, SensorClient, TickClock, time_of
from watched_node import Log

SECONDS = 10
TREES, LEAST_BRANCHES = 256, 200
MOST_BYTES = 100e3  # limit per second of forest/state while no tree is promoted
TF_BUDGET, MARKER_POINTS = 60, 30000  # same values as in forest_state.test


def size_of(message):
    out = io.BytesIO()
    message.serialize(out)
    return len(out.getvalue())


class ForestState(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.clock = TickClock(1000 * RATE)
        cls.clock.begin(cls.forest)
        cls.sensor = SensorClient()

    def run_sensed(self, seconds):
        """Moves a sensor through the forest, so that levels change continuously."""
        for half in range(2 * seconds):
            self.sensor.move_to(-60.0 + 3.0 * half, -10.0, 4.0, self.forest)
            self.clock.run(RATE // 2, self.forest)

    # S1-02: the service knows every (tree, branch) id of 256 trees with at least 200 branches each.
    def test_every_branch_of_every_tree_can_be_asked_for(self):
        self.assertIn('there are %d, from 0' % TREES, self.forest.refusal(tree=TREES))
        for tree in range(TREES):
            answer = self.forest.tree(tree)
            count = len(answer.transforms.poses)
            self.assertGreaterEqual(count, LEAST_BRANCHES, tree)
            self.assertEqual(count, len(answer.parents))
            self.assertTrue(self.forest.set_tf(tree, [0, count - 1], True).success)
            self.assertTrue(self.forest.set_tf(tree, [0, count - 1], False).success)
            self.assertIn('branches: %d is unknown' % count,
                          self.forest.set_tf(tree, [count], True).message)

    # There are 30 messages per second of the clock, one per tick, and they are small.
    def test_state_comes_at_its_rate_and_is_small(self):
        before, tick = len(self.forest.state.messages), self.clock.tick
        self.run_sensed(SECONDS)
        received = self.forest.state.messages[before:]
        self.assertEqual([m.header.stamp for m in received],
                         [time_of(tick + 1 + i) for i in range(RATE * SECONDS)])
        self.assertEqual([m.sequence - received[0].sequence for m in received],
                         list(range(len(received))))
        self.assertEqual(sum(m.key_frame for m in received), SECONDS)
        self.assertTrue(any(m.trees for m in received if not m.key_frame), 'no level changed')
        sizes = [size_of(m) for m in received]
        print('forest/state: %d messages, %.1f kB/s, largest %.1f kB; layout %.1f kB' % (
            len(received), sum(sizes) / SECONDS / 1e3, max(sizes) / 1e3,
            size_of(self.forest.layout.messages[-1]) / 1e3))
        self.assertLess(sum(sizes) / SECONDS, MOST_BYTES)

    def test_frames_stay_within_their_budget(self):
        count = len(self.forest.tree(7).transforms.poses)
        self.assertGreater(count, TF_BUDGET)
        self.clock.run(6 * RATE, self.forest)  # After this time no level changes any more.
        tf = Log('/tf', TFMessage)
        answer = self.forest.set_tf(7, list(range(TF_BUDGET)), True)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual((answer.frames, answer.budget), (TF_BUDGET, TF_BUDGET))
        for request in ((7, 'all', True), (8, [0], True)):
            answer = self.forest.set_tf(*request)
            self.assertFalse(answer.success)
            self.assertRegex(answer.message,
                             r'frames = \d+ would pass the budget of %d' % TF_BUDGET)
            self.assertEqual(answer.frames, TF_BUDGET)
        self.clock.run_until(lambda: len(tf.messages) >= 10, 'frames', self.forest)
        received = list(tf.messages)
        for message in received:
            self.assertEqual([t.child_frame_id for t in message.transforms],
                             ['tree_7/branch_%d' % i for i in range(TF_BUDGET)])
        stamps = [m.transforms[0].header.stamp for m in received]
        self.assertEqual(len(set(stamps)), len(stamps), 'a transform came twice')
        pose = self.forest.tree(7, stamps[-1]).transforms.poses[20]
        sent = received[-1].transforms[20].transform
        self.assertEqual((pose.position.x, pose.orientation), (sent.translation.x, sent.rotation))
        self.assertEqual(self.forest.set_tf(7, 'all', False).frames, 0)
        tf.close()

    # The stock markers are two lists of constant size that are built only for a subscriber.
    def test_markers_are_few_constant_and_only_on_demand(self):
        self.run_sensed(2)
        self.assertEqual(self.forest.diagnostics('governor')['Marker points'], 0)
        markers = Log('/forest/markers', MarkerArray)
        while len(markers.messages) < 10:
            self.run_sensed(1)
        for array in markers.messages:
            self.assertEqual([(m.ns, m.id, m.type, m.action) for m in array.markers],
                             [('bark', 0, Marker.TRIANGLE_LIST, Marker.ADD),
                              ('leaves', 1, Marker.TRIANGLE_LIST, Marker.ADD)])
            sizes = [len(m.points) for m in array.markers]
            self.assertLessEqual(sum(sizes), MARKER_POINTS)
            self.assertEqual(sizes, [len(m.points) for m in markers.messages[0].markers])
            self.assertEqual(sizes, [len(m.colors) for m in array.markers])
        self.assertGreater(self.forest.diagnostics('governor')['Marker points'], 0.5 * MARKER_POINTS)
        markers.close()

    # N14: a latched cylinder for each trunk, at its foot.
    def test_trunks_are_latched_cylinders(self):
        trunks = Log('/forest/trunks', MarkerArray)
        self.clock.run_until(lambda: trunks.messages, 'trunks', self.forest)
        cylinders = trunks.messages[-1].markers[1:]
        seeds = self.forest.layout.messages[-1].trees
        self.assertGreater(len(seeds), 0)
        self.assertEqual([(m.id, m.type) for m in cylinders],
                         [(tree, Marker.CYLINDER) for tree in range(TREES)])
        self.assertEqual([(m.pose.position.x, m.pose.position.y) for m in cylinders[:len(seeds)]],
                         [(seed.position.x, seed.position.y) for seed in seeds])
        trunks.close()

    # forest/branches has only the selected trees, with the same poses as get_tree.
    def test_branches_of_selected_trees_are_sent(self):
        branches = Log('/forest/branches', BranchTransforms)
        self.clock.run_until(lambda: len(branches.messages) >= 10, 'branches', self.forest)
        self.assertEqual({m.tree for m in branches.messages}, {3, 200})
        last = branches.messages[-1]
        self.assertEqual(last.poses,
                         self.forest.tree(last.tree, last.header.stamp).transforms.poses)
        branches.close()


if __name__ == '__main__':
    rospy.init_node('forest_state_test')
    rostest.rosrun('vegetation_sim', 'forest_state', ForestState)
