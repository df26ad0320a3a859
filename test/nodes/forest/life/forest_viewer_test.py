#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Viewers determine the levels of detail that displays draw, and change nothing else (N8, S1-22)."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from forest_rig import RATE, Animator, TickClock, ViewerClient, time_of
from watched_node import Log, publisher, wait_for_readers

WEST, EAST = 0, 7  # trees at x = 0 m and 960 m
BESIDE_WEST, BESIDE_EAST, FAR = (-12.0, 0.0, 5.0), (945.0, 8.0, 5.0), (-400.0, 0.0, 5.0)
FIXED_LEVEL = 2


class ForestViewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.filmed = Animator('/filmed/forest_animator', '/filmed/')
        cls.all = cls.forest, cls.filmed
        cls.clock = TickClock(1000 * RATE)
        cls.clock.begin(*cls.all)
        cls.viewer = ViewerClient()
        cls.frames = publisher('/tf', TFMessage)
        cls.server = Client('/forest_animator', timeout=30)
        wait_for_readers('/tf', *(a.process for a in cls.all))

    def setUp(self):
        self.clock.run(6 * RATE, *self.all)  # All viewers expire and all transitions end.

    def view_from(self, place, seconds=2, viewer=None):
        """Publishes a viewer once a second, as rviz does. Returns the levels of the two trees."""
        for _ in range(seconds):
            (viewer or self.viewer).move_to(*place, self.forest)
            self.clock.run(RATE, *self.all)
        return self.forest.view_level(WEST), self.forest.view_level(EAST)

    def film(self, place):
        """Moves the camera frame. Returns when tf of the node has it."""
        frame = TransformStamped(child_frame_id='camera')
        frame.header.frame_id, frame.header.stamp = 'map', time_of(self.clock.tick + 1)
        move = frame.transform.translation
        move.x, move.y, move.z = place
        frame.transform.rotation.w = 1.0
        self.frames.publish([frame])
        near, far = (WEST, EAST) if place == BESIDE_WEST else (EAST, WEST)
        self.clock.run_until(
            lambda: self.filmed.view_level(near) > self.filmed.view_level(far),
            'the levels of a camera at %s' % (place,), *self.all)

    def test_levels_follow_the_viewer(self):
        west, east = self.view_from(BESIDE_WEST)
        self.assertGreater(west, east)
        west, east = self.view_from(BESIDE_EAST)
        self.assertLess(west, east)

    def test_the_world_does_not_depend_on_viewers(self):
        before = self.forest.state.messages[-1].hash
        self.view_from(BESIDE_WEST)
        self.assertEqual(self.forest.state.messages[-1].hash, before)
        self.assertEqual({self.forest.level(tree) for tree in range(17)}, {FIXED_LEVEL})

    def test_no_viewer_gives_every_tree_the_fixed_level(self):
        self.view_from(BESIDE_WEST)
        self.clock.run(6 * RATE, *self.all)
        self.assertEqual({self.forest.view_level(tree) for tree in range(17)}, {FIXED_LEVEL})
        last = [m for m in self.forest.view.messages if m.key_frame][-1]
        self.assertEqual((last.base_level, len(last.trees)), (FIXED_LEVEL, 0))

    def test_the_finest_of_several_viewers_wins(self):
        far, _ = self.view_from(FAR)
        other = ViewerClient('other')
        other.move_to(*BESIDE_WEST, self.forest)
        both, _ = self.view_from(FAR)
        self.assertGreater(both, far)
        left, _ = self.view_from(FAR, 5)  # The other viewer has expired.
        self.assertEqual(left, far)
        other.close()

    def test_a_frame_of_tf_is_a_viewer(self):
        self.film(BESIDE_WEST)
        self.film(BESIDE_EAST)
        self.assertEqual(self.forest.view_level(WEST), FIXED_LEVEL)  # The other node has no camera.

    def test_tolerance_and_highest_level_take_effect(self):
        west, _ = self.view_from(BESIDE_WEST)
        self.server.update_configuration({'tolerance': 300.0})
        coarse, _ = self.view_from(BESIDE_WEST)
        self.assertLess(coarse, west)
        self.server.update_configuration({'tolerance': 1.0, 'highest_level': 1})
        limited, _ = self.view_from(BESIDE_WEST)
        self.assertEqual(limited, 1)
        self.server.update_configuration({'highest_level': 6})

    def test_the_governor_reports_levels_and_reason(self):  # N7, N13
        reports = Log('/diagnostics', DiagnosticArray)
        self.view_from(BESIDE_WEST)

        def modes(all_messages):
            found = [s for m in all_messages for s in m.status
                     if s.name == 'forest_animator: governor']
            values = {pair.key: float(pair.value) for pair in found[-1].values} if found else {}
            return values.get('Trees in modes', 0) > 0 and (found[-1].message, values)
        why, values = reports.wait(modes, 'trees in modes')
        reports.close()
        self.assertIn(why, ('the tolerance is held', 'there are no finer tiers, or no room for modes'))
        self.assertLessEqual(values['Predicted frame time [ms]'], values['Frame time budget [ms]'])
        self.assertEqual(self.forest.view_level(WEST), 7)

    # N9: what a viewer sees is off by pixels that are millimetres at the tree; a coarser tolerance
    # costs less and is off by more.
    def test_errors_are_published_beside_their_costs(self):
        def errors(tolerance):
            self.server.update_configuration({'tolerance': tolerance})
            self.view_from(BESIDE_WEST)
            return self.forest.predicted_errors('/forest/errors')
        fine, coarse = errors(1.0), errors(20.0)
        self.server.update_configuration({'tolerance': 1.0})
        view = fine['forest/view']
        self.assertTrue(0.0 < view.pixels <= 1.0 or view.over > 0, view.pixels)
        self.assertTrue(1e-5 < view.metres < 0.1, view.metres)
        self.assertGreater(coarse['forest/view'].pixels, view.pixels)
        self.assertLess(coarse['forest/view'].cost, view.cost)
        self.assertEqual((view.unit, coarse['forest/view'].tolerance), ('ms', 20.0))
        self.assertEqual(fine['forest/state'].pixels, 0.0)


if __name__ == '__main__':
    rospy.init_node('forest_viewer_test')
    rostest.rosrun('vegetation_sim', 'forest_viewer', ForestViewer)
