#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the topics and services of canopy_animator: layout, state, events, markers, samples and
errors."""
import math
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from std_srvs.srv import Trigger
from vegetation_sim.msg import CanopyEvent, WindField
from visualization_msgs.msg import MarkerArray

from canopy_rig import Leaves, half
from forest_rig import RATE, TickClock, ViewerClient
from waiting import wait_for
from watched_node import Log, publisher, serves

NAN = float('nan')
TOP = (0.0, 0.0, 1.6)  # top of the nearer shrub


class CanopyStateTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.leaves, cls.clock = Leaves(), TickClock(1000 * RATE)
        cls.leaves.wait_until_up('/wind')
        cls.early = serves('/canopy_animator/sample')
        cls.clock.begin(cls.leaves)
        cls.clock.run(4 * RATE, cls.leaves)

    def test_nothing_is_sampled_before_time_begins(self):
        self.assertFalse(self.early)

    # S3-12, S3-24: leaves follow the published wind and the foot does not move.
    def test_leaves_follow_the_wind_and_the_foot_stands(self):
        top, foot = self.leaves.samples(TOP, (0.0, 0.0, 0.0)).samples
        self.assertGreater(top.wind.y, 1.0)
        self.assertGreater(top.displacement.y, 0.02)
        self.assertEqual((foot.displacement.x, foot.displacement.y, foot.displacement.z), (0, 0, 0))
        self.assertEqual((top.plant, self.leaves.at(2.2, 0.3, 1.0).plant), (0, 1))

    # S3-05: the layers of the only region are numbered from the nearest one.
    def test_layers_are_counted_from_the_viewer(self):
        answer = self.leaves.samples((-0.9, 0.0, 1.0), (2.9, 0.3, 1.0))
        self.assertEqual(answer.layers, 3)
        self.assertEqual([s.layer for s in answer.samples], [0, 2])

    def test_states_count_ticks_and_carry_the_plane(self):
        states = self.leaves.state.messages[-30:]
        self.assertEqual([b.sequence - a.sequence for a, b in zip(states, states[1:])], [1] * 29)
        last = states[-1]
        self.assertEqual((len(last.right), len(last.up)), (32 * 32, 32 * 32))
        self.assertEqual(last.layout_hash, self.leaves.layout.messages[-1].hash)
        mean = sum(half(bits) for bits in last.right) / 1024
        self.assertLess(mean, -1.0)  # North is to the left of a camera that faces east.
        self.assertEqual(last.header.frame_id, 'map')
        with_hash = [m for m in self.leaves.state.messages if m.hash]
        self.assertGreaterEqual(len(with_hash), 3)

    # The lists have a constant size, so that rviz updates them in place, and they keep the budget.
    def test_markers_keep_their_size_and_move(self):
        log = Log('/canopy/markers', MarkerArray)
        log.wait(lambda all: len(all) >= 3, 'markers',
                 lambda: self.clock.run(3, self.leaves))
        log.close()
        first, last = log.messages[0], log.messages[-1]
        sizes = [[len(m.points) for m in a.markers] for a in log.messages]
        self.assertEqual(sizes, [sizes[0]] * len(sizes))
        self.assertLessEqual(sum(sizes[0]), 6000)
        self.assertEqual([m.type for m in first.markers], [11, 11, 11])
        moved = [math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))
                 for a, b in zip(first.markers[0].points, last.markers[0].points)]
        self.assertGreater(max(moved), 1e-3)
        self.assertLess(max(moved), 1.0)
        # S3-02: stems do not move.
        self.assertEqual(first.markers[1].points, last.markers[1].points)

    # N7: two near shrubs of 200 leaves are drawn completely within 6 000 points.
    def test_governor_reports_levels_and_reason(self):
        log = Log('/canopy/markers', MarkerArray)
        log.wait(len, 'markers', lambda: self.clock.run(3, self.leaves))
        values = self.leaves.diagnostics('governor')
        error = self.leaves.predicted_errors('/canopy/errors')['canopy/markers']
        log.close()
        # N9: a plant that is drawn completely has no error.
        self.assertEqual((error.pixels, error.metres, error.over), (0.0, 0.0, 0))
        self.assertEqual((error.cost, error.unit), (2 * 200 * 6, 'points'))
        self.assertEqual(values['Plants that the budget holds back'], 0)
        self.assertEqual(values['Cost [points]'], 2 * 200 * 6)
        self.assertEqual(values['Cost that the tolerance asks for [points]'], 2 * 200 * 6)
        self.assertLess(values['Cost [points]'], values['Budget [points]'])
        self.assertLessEqual(values['Marker points'], values['Marker budget [points]'])
        self.assertEqual(values['Plants: with 100 % of their leaves'], 2)

    def expect_viewer(self, fits):
        """Waits until the newest viewer event fulfils `fits`."""
        self.leaves.events.wait(
            lambda all: any(map(fits, [e for e in all if e.kind == CanopyEvent.VIEWER][-1:])),
            'a viewer')

    # S3-04, S3-W8: layers are cut for one viewer; other viewers are counted but have no effect.
    def test_layers_are_cut_for_one_viewer(self):
        one, other = ViewerClient('one'), ViewerClient('other')
        one.move_to(1.0, 0.0, 1.5, self.leaves)
        self.clock.run(1, self.leaves)
        other.move_to(-50.0, 0.0, 1.5, self.leaves)
        self.clock.run(1, self.leaves)
        self.expect_viewer(lambda event: event.eye.position.x == 1.0)
        self.assertEqual(self.leaves.state.messages[-1].eye.position.x, 1.0)
        self.assertGreater(self.leaves.diagnostics()['Messages of other viewers'], 0)
        # The silent viewer expires, and the plane's own camera is used.
        self.clock.run(4 * RATE, self.leaves)
        self.expect_viewer(lambda event: event.gone)
        self.assertEqual(self.leaves.state.messages[-1].eye.position.x, -5.0)
        one.close(), other.close()

    # S3-13, S3-29: wind from one side can be set while the node runs.
    def test_a_side_wind_can_be_set_live(self):
        server = Client('/canopy_animator', timeout=30)
        layouts = len(self.leaves.layout.messages)
        server.update_configuration({'law_gain': 0.0, 'rightward': 8.0, 'near_layers': 5})
        self.clock.run(5 * RATE, self.leaves)
        self.assertLess(self.leaves.at(*TOP).displacement.y, -0.01)  # South is to the right.
        self.assertEqual(self.leaves.samples(TOP).layers, 5)
        wait_for(lambda: len(self.leaves.layout.messages) > layouts, 'another layout')
        self.assertEqual(self.leaves.layout.messages[-1].hash,
                         self.leaves.state.messages[-1].layout_hash)
        before = self.leaves.diagnostics()['Inputs refused']
        server.update_configuration({'near_layers': 0, 'mid_layers': 0, 'far_layers': 0})
        self.assertEqual(self.leaves.diagnostics()['Inputs refused'], before + 1)
        server.update_configuration({'law_gain': 1.0, 'rightward': 0.0, 'near_layers': 3})
        self.clock.run(4 * RATE, self.leaves)
        self.assertGreater(self.leaves.at(*TOP).displacement.y, 0.01)

    def test_reset_is_a_fresh_start(self):
        answer = rospy.ServiceProxy('/canopy_animator/reset', Trigger)()
        self.assertTrue(answer.success, answer.message)
        self.clock.run(1, self.leaves)
        self.assertEqual(self.leaves.state.messages[-1].sequence, 1)
        self.assertEqual(self.leaves.at(*TOP).displacement.y, 0.0)
        self.clock.run(4 * RATE, self.leaves)
        self.assertGreater(self.leaves.at(*TOP).displacement.y, 0.01)

    def test_bad_requests_and_messages_are_rejected_with_an_error_that_names_the_field(self):
        refused = self.leaves.diagnostics()['Inputs refused']
        self.assertIn('points has 0 entries, allowed are 1 to 100000', self.leaves.refusal())
        self.assertIn('points[1].z = nan m is not finite',
                      self.leaves.refusal(TOP, (0, 0, NAN)).replace('-nan', 'nan'))
        self.assertIn("frame_id = 'nowhere' is not known",
                      self.leaves.refusal(TOP, frame_id='nowhere'))
        self.assertIn('stamp is not that of the last tick',
                      self.leaves.refusal(TOP, stamp=rospy.Time(1)))
        viewer = ViewerClient('bad')
        viewer.message.pose.orientation.w = 0.0
        viewer.send(viewer.message, self.leaves)
        wind = publisher('/wind', WindField)
        wait_for(lambda: wind.get_num_connections() > 0, 'readers of the wind')
        wind.publish(WindField())
        self.leaves.settle()
        self.assertEqual(self.leaves.diagnostics()['Inputs refused'], refused + 2)
        viewer.close()
        wind.unregister()


if __name__ == '__main__':
    rospy.init_node('canopy_state_test')
    rostest.rosrun('vegetation_sim', 'canopy_state', CanopyStateTest)
