#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Services and tools cut the plants of canopy_animator: events, states, a late subscriber, a
snapshot, a reset, and a replay with the same hashes."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Header
from std_srvs.srv import SetBool, Trigger
from vegetation_sim.msg import CanopyEvent, CanopyState, ErrorCode, GrassCut
from vegetation_sim.srv import CutPlants, LoadSnapshot, SaveSnapshot

from canopy_rig import ReplayedLeaves
from crowd_rig import Cart
from forest_rig import RATE, time_of
from replaying import compare_replay
from watched_node import Log

BEGIN = 1000 * RATE
TOP = 1.6  # of a shrub [m]
NAN = float('nan')


class CanopyCut(ReplayedLeaves, unittest.TestCase):
    def setUp(self):
        self.cut = rospy.ServiceProxy('/canopy_animator/cut', CutPlants)
        self.begin(BEGIN)
        self.cart = Cart(self.leaves)

    def area(self, height, *corners, radius=0.0):
        return GrassCut(outline=[Point(x, y, 0.0) for x, y in corners], radius=radius,
                        height=height)

    def cuts(self):
        """Returns the heights of the last list by plant."""
        last = [m for m in self.leaves.state.messages if m.lists_cuts][-1]
        return dict(zip(last.cut_plants, last.cut_heights))

    def last_cut(self):
        return [e for e in self.leaves.events.messages if e.kind == CanopyEvent.CUT][-1]

    def test_plants_are_cut(self):
        self.expect_a_service_to_cut()
        self.expect_refusals()
        self.expect_a_tool_to_cut()
        self.expect_a_late_subscriber_to_know()
        self.expect_the_map_to_show_cut_plants()
        self.expect_snapshot_and_reset()
        self.expect_a_cut_after_a_reset()
        self.expect_equal_replay()

    def expect_a_service_to_cut(self):
        self.assertEqual(self.cuts(), {})
        corners = (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)
        answer = self.cut(cut=self.area(0.9, *corners))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.plants, 1)
        self.assertEqual(self.cuts(), {})
        self.run_ticks(1)
        last = self.leaves.state.messages[-1]
        self.assertTrue(last.lists_cuts)
        self.assertEqual((last.cut_plants, last.cut_heights), ((0,), (0.9,)))
        event = self.last_cut()
        self.assertEqual((event.cut_plants, event.cut_height), ((0,), 0.9))
        self.assertAlmostEqual(event.cut_lengths[0], TOP - 0.9, 12)
        self.run_ticks(1)
        self.assertFalse(self.leaves.state.messages[-1].lists_cuts)
        # A higher cut finds nothing.
        answer = self.cut(cut=self.area(1.0, *corners))
        self.assertEqual((answer.success, answer.plants), (True, 0))
        later = time_of(self.clock.tick + 5)
        answer = self.cut(header=Header(stamp=later), cut=self.area(0.8, (0.0, 0.1), radius=0.2))
        self.assertEqual((answer.success, answer.plants), (True, 1))
        self.run_ticks(4)
        self.assertEqual(self.cuts(), {0: 0.9})
        self.run_ticks(1)
        self.assertEqual(self.cuts(), {0: 0.8})
        self.assertEqual(self.leaves.diagnostics()['Plants that have been cut'], 1)

    def expect_refusals(self):
        for text, request in (
                ('outline has 0 points', dict(cut=self.area(0.1))),
                ('outline[0].x = nan m is not finite', dict(cut=self.area(0.1, (NAN, 0), radius=1))),
                ('height = 9 m is outside 0 to 5 m', dict(cut=self.area(9.0, (0, 0), radius=1))),
                ("'nowhere' is not known in 'map'",
                 dict(header=Header(frame_id='nowhere'), cut=self.area(0.1, (0, 0), radius=1)))):
            answer = self.cut(**request)
            self.assertFalse(answer.success)
            self.assertIn(text, answer.message)
        replay = rospy.ServiceProxy('/again/canopy_animator/cut', CutPlants)
        answer = replay(cut=self.area(0.1, (0, 0), radius=1))
        self.assertEqual(answer.error_code, ErrorCode.NOT_AVAILABLE)

    def drive(self):
        """Drives the tool over the second shrub, 0.4 m per tick, and away."""
        for i in range(6):
            self.cart.put(0.95 + 0.4 * i, 0.5, time_of(self.clock.tick + 1))
            self.run_ticks(1)
        self.cart.put(50.0, 0.5, time_of(self.clock.tick + 1))
        self.run_ticks(2)

    def expect_a_tool_to_cut(self):
        switch = rospy.ServiceProxy('/canopy_animator/cutting', SetBool)
        self.assertTrue(switch(False).success)
        self.drive()
        self.assertEqual(self.cuts(), {0: 0.8})
        self.assertTrue(switch(True).success)
        self.drive()
        self.assertEqual(self.cuts(), {0: 0.8, 1: 0.2})
        event = self.last_cut()
        self.assertEqual(event.cut_plants, (1,))
        self.assertAlmostEqual(event.cut_lengths[0], TOP - 0.2, 12)
        self.assertFalse(rospy.ServiceProxy('/again/canopy_animator/cutting', SetBool)(True).success)

    def expect_a_late_subscriber_to_know(self):
        late = Log('/canopy/state', CanopyState)
        late.wait(len, 'a state', lambda: self.run_ticks(1))
        self.run_ticks(RATE)
        lists = [m for m in late.messages if m.lists_cuts]
        self.assertEqual(lists[0].cut_plants, (0, 1))
        late.close()

    def expect_the_map_to_show_cut_plants(self):
        """The shrubs stand at (0, 0) and (2, 0.3), so that the map has five cells in a row."""
        cover = Log('/canopy/cover/cut', OccupancyGrid)
        last = cover.wait(len, 'a map', lambda: self.run_ticks(1)) and cover.messages[-1]
        self.assertEqual(last.header.frame_id, 'map')
        self.assertEqual((last.info.width, last.info.height, last.info.resolution), (5, 1, 0.5))
        self.assertEqual((last.info.origin.position.x, last.info.origin.position.y), (0.0, 0.0))
        self.assertEqual(last.data, (100, -1, -1, -1, 100))
        self.assertTrue(rospy.ServiceProxy('/canopy_animator/reset', Trigger)().success)
        self.run_ticks(RATE + 1)
        self.assertEqual(cover.wait(lambda all: [m for m in all if m.data[0] == 0], 'no cuts',
                                    lambda: self.run_ticks(1))[0].data, (0, -1, -1, -1, 0))
        corners = (1.5, -1.0), (3.0, -1.0), (3.0, 1.0), (1.5, 1.0)
        self.assertEqual(self.cut(cut=self.area(0.2, *corners)).plants, 1)
        before = len(cover.messages)
        self.run_ticks(1)
        self.assertEqual(cover.wait(lambda all: all[before:], 'a map after a cut')[0].data,
                         (0, -1, -1, -1, 100))
        self.cut(cut=self.area(0.8, (0.0, 0.1), radius=0.2))
        self.run_ticks(1)
        self.assertEqual(self.cuts(), {0: 0.8, 1: 0.2})
        cover.close()

    def expect_snapshot_and_reset(self):
        saved = rospy.ServiceProxy('/canopy_animator/save_snapshot', SaveSnapshot)(name='cut')
        self.assertTrue(saved.success, saved.message)
        self.assertTrue(rospy.ServiceProxy('/canopy_animator/reset', Trigger)().success)
        self.run_ticks(2)
        self.assertEqual(self.cuts(), {})
        loaded = rospy.ServiceProxy('/canopy_animator/load_snapshot', LoadSnapshot)(name='cut')
        self.assertTrue(loaded.success, loaded.message)
        self.again.settle()
        self.run_ticks(2)
        self.assertEqual(self.cuts(), {0: 0.8, 1: 0.2})

    def expect_a_cut_after_a_reset(self):
        """A cut that waits takes the plants as they are at its tick."""
        later = time_of(self.clock.tick + 5)
        answer = self.cut(header=Header(stamp=later), cut=self.area(0.9, (0.0, 0.0), radius=9.0))
        self.assertEqual((answer.success, answer.plants), (True, 0))
        self.assertTrue(rospy.ServiceProxy('/canopy_animator/reset', Trigger)().success)
        self.run_ticks(2)
        self.assertEqual(self.cuts(), {})
        self.run_ticks(4)
        self.assertEqual(self.cuts(), {0: 0.9, 1: 0.9})

    def expect_equal_replay(self):
        self.run_ticks(RATE)
        states, different = compare_replay(
            self, lambda: (self.leaves.hashes(), self.again.hashes()))
        self.assertGreater(states, 2)
        self.assertEqual(different, [])
        lists = [{m.header.stamp: (m.cut_plants, m.cut_heights)
                  for m in node.state.messages if m.lists_cuts} for node in (self.leaves, self.again)]
        both = sorted(set(lists[0]) & set(lists[1]))
        self.assertGreater(sum(bool(lists[0][s][0]) for s in both), 3)
        self.assertEqual([s for s in both if lists[0][s] != lists[1][s]], [])


if __name__ == '__main__':
    rospy.init_node('canopy_cut_test')
    rostest.rosrun('vegetation_sim', 'canopy_cut', CanopyCut)
