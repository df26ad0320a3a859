#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Displays and lidars receive the people that they see, and no others; what they see is that of a
listener that receives all, and the people do not depend on who listens."""
import math
import unittest

import rospy
import rostest
from vegetation_sim.msg import AgentStates, CrowdView, NearAgents, ScanReport

from crowd_rig import Crowd
from forest_rig import RATE, TickClock, ViewerClient, time_of
from scan_rig import LidarPair
from waiting import wait_for
from watched_node import Log

HERE, THERE = range(20), range(20, 40)  # ids of the two groups, at x = 0 and x = 500
LIDAR = dict(rate=10, delay=0.1, noise=0.0, rings=12, columns=240, elevation_low=-0.3, elevation_high=0.3,
             range_max=30.0)
WAY = 25.0  # of the lidars to both sides, farther than the margin of a region [m]


def ids_of(view):
    return [first + k for first, count in zip(view.first_id, view.id_count) for k in range(count)]


class CrowdInterest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.crowd = Crowd()
        cls.view = Log('/agents/view', CrowdView)
        cls.near = Log('/agents/near', NearAgents)
        cls.unseen = Log('/unseen/agents', AgentStates)
        cls.clock = TickClock(1000 * RATE)
        cls.crowd.wait_until_up()
        for log in (cls.view, cls.near, cls.unseen):
            wait_for(log.connected, log.topic)
        cls.run_ticks(5)

    @classmethod
    def run_ticks(cls, ticks):
        for _ in range(ticks):
            cls.clock.run(1, cls.crowd)
            for log in (cls.view, cls.near, cls.unseen):
                log.wait_for_stamp(time_of(cls.clock.tick))

    def test_1_without_listeners_all_are_sent(self):
        self.assertEqual(ids_of(self.view.messages[-1]), [*HERE, *THERE])
        self.assertEqual([agent.id for agent in self.near.messages[-1].agents], [*HERE, *THERE])
        self.assertEqual(self.near.messages[-1].discs, [])

    def test_2_displays_receive_whom_they_see(self):
        eye = ViewerClient()
        for x, seen in ((0.0, HERE), (500.0, THERE), (250.0, [])):
            eye.move_to(x, 0.0, 2.0, self.crowd)
            self.run_ticks(1)
            self.assertEqual(ids_of(self.view.messages[-1]), [*seen], x)
            self.assertEqual(len(self.crowd.agents()), 40)  # on the topic of all
            self.assertEqual(len(self.near.messages[-1].agents), 40)  # No sensor has spoken.
        self.run_ticks(3 * RATE + 2)  # The viewer is silent.
        self.assertEqual(len(ids_of(self.view.messages[-1])), 40)
        eye.close()

    def test_3_lidars_measure_the_same_with_those_near_them(self):
        lidars = LidarPair('/agent_crowd', 'agents', 'agents/near', ['agents/motions'], **LIDAR)
        self.addCleanup(lidars.close)
        base = 0.0

        def place(sweep):
            return (base + WAY * math.sin(0.04 * sweep), 3.0, 1.0)

        for sweep in range(150):
            if sweep == 60:
                lidars.leave_whole(place(sweep), self.clock, lambda: self.run_ticks(1))
                self.assertEqual({agent.id for agent in self.near.messages[-1].agents}, set(HERE))
                base = 500.0
            lidars.move(place(sweep), self.clock, lambda: self.run_ticks(1))
        near = self.near.messages[-1]
        self.assertEqual({agent.id for agent in near.agents}, set(THERE))
        self.assertEqual(near.hash, self.crowd.state.messages[-1].hash)
        compared, unequal = lidars.compare()
        self.assertGreater(len(compared), 130)
        self.assertEqual(unequal, [])
        hits = [m.counts[ScanReport.PERSON] for m in lidars.scanners[0].report.messages]
        self.assertGreater(min(hits[:50]), 5)
        self.assertGreater(min(hits[-50:]), 5)
        lidars.name_rival('/agents/near', NearAgents)

    def test_4_the_people_do_not_depend_on_listeners(self):
        watched = self.crowd.hashes()
        unseen = {m.header.stamp: m.hash for m in self.unseen.messages}
        stamps = sorted(set(watched) & set(unseen))
        self.assertGreater(len(stamps), 500)
        self.assertEqual([s for s in stamps if watched[s] != unseen[s]], [])


if __name__ == '__main__':
    rospy.init_node('crowd_interest_test')
    rostest.rosrun('vegetation_sim', 'crowd_interest', CrowdInterest)
