#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The replayed events of a run give the same hashes (N6), whatever requests the run has
received."""
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from vegetation_sim.msg import AgentSpawn, CrowdEvent

from crowd_rig import Cart, Crowd, at
from forest_rig import TickClock, time_of
from waiting import wait_for
from watched_node import listens, publisher

START = 1700000000 * 30  # Unix time, at which single precision has no fraction of a second left


class CrowdReplay(unittest.TestCase):
    def setUp(self):
        rospy.init_node('crowd_replay_test')
        self.crowd = Crowd()
        self.again = Crowd('/again/agent_crowd', '/again/')
        self.again.events = self.crowd.events
        self.clock = TickClock(START)
        self.crowd.wait_until_up()
        self.again.wait_until_up('/agents/events')

    def send_cover(self):
        cover = OccupancyGrid()
        cover.header.frame_id = 'map'
        cover.info.width = cover.info.height = 20
        cover.info.resolution = 1.0
        cover.info.origin.position.x = cover.info.origin.position.y = -10.0
        cover.data = [(7 * i) % 100 for i in range(400)]
        sender = publisher('/grass/cover/resistance', OccupancyGrid)
        wait_for(lambda: sender.get_num_connections() >= 2, 'readers of the cover')
        sender.publish(cover)
        for crowd in (self.crowd, self.again):
            crowd.settle()

    def run_ticks(self, count):
        """Runs single ticks; before each one the replay has received the events of the previous
        tick."""
        for _ in range(count):
            self.clock.run(1, self.crowd)
            self.again.settle()

    def test_same_hashes(self):
        crowd, clock = self.crowd, self.clock
        self.run_ticks(20)
        self.send_cover()
        self.run_ticks(10)
        self.assertTrue(crowd.spawn(like=AgentSpawn(position=at(3, 3)), count=3, spread=1.0).success)
        cart = Cart(crowd)
        for i in range(30):
            cart.put(-6.0 + 0.05 * i, 5.0, time_of(clock.tick))
            self.run_ticks(1)
        goal = PointStamped()
        goal.point = at(6, -6)
        self.assertTrue(crowd.set_goal(ids=[0, 9], goal=goal).success)
        Client('/agent_crowd').update_configuration({'pace': 1.2, 'neighbours': 4})
        self.run_ticks(30)
        self.assertTrue(crowd.remove(ids=[2]).success)
        self.run_ticks(30)
        end = time_of(clock.tick)
        self.run_ticks(16)  # The replay runs half a second behind.
        self.again.state.wait(lambda all: any(m.header.stamp == end for m in all), 'the end',
                              lambda: clock.show(clock.tick))
        for kind in (CrowdEvent.SPAWN, CrowdEvent.REMOVE, CrowdEvent.GOAL, CrowdEvent.ROBOT,
                     CrowdEvent.COVER, CrowdEvent.SETTINGS, CrowdEvent.RESET):
            crowd.expect_event(kind)
        run, replay = crowd.hashes(), self.again.hashes()
        both = sorted(set(run) & set(replay))
        self.assertGreater(len(both), 100)
        self.assertEqual([s for s in both if run[s] != replay[s]], [])
        self.assertIn('recorded events only', self.again.spawn().message)


if __name__ == '__main__':
    rostest.rosrun('vegetation_sim', 'crowd_replay_test', CrowdReplay)
