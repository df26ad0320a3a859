#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Simulation: a training loop of reset, act, step and observe."""
import unittest
from unittest import mock

import roslib.packages
import rospy
import rostest
from nav_msgs.msg import OccupancyGrid
from vegetation_sim import Crowd, Simulation, VegetationError
from vegetation_sim.msg import AgentStates, CrowdEvent, ForestState

from waiting import wait_for
from watched_node import publisher

STEPS = 200


def episode(simulation, crowd):
    """Runs an episode in which walkers get goals. Returns the hashes of all ticks."""
    hashes = [simulation.reset()['/agents'].hash]
    for step in range(STEPS):
        if step % 20 == 0:
            crowd.send([0, 1], (0.03 * step - 5.0, 5.0))
        hashes.append(simulation.step()['/agents'].hash)
    return hashes


def cover(stamp):
    out = OccupancyGrid()
    out.header.frame_id, out.header.stamp = 'map', stamp
    out.info.width = out.info.height = 40
    out.info.resolution = 1.0
    out.info.origin.position.x = out.info.origin.position.y = -20.0
    out.data = [80 + int(stamp.to_sec()) % 20] * 1600  # each map has another hash
    return out


class SimulationTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulation = Simulation({'agents': AgentStates})
        cls.crowd = Crowd()

    def test_three_episodes_have_the_same_states_and_differ_from_one_without_actions(self):
        first = episode(self.simulation, self.crowd)
        self.assertEqual(len(set(first)), len(first))
        self.assertEqual(episode(self.simulation, self.crowd), first)
        self.assertEqual(episode(self.simulation, self.crowd), first)
        self.simulation.reset()
        self.assertNotEqual(self.simulation.step(STEPS)['/agents'].hash, first[-1])

    def send_cover(self, stamp):
        """Sends a map of grass that resists, and steps until it acts."""
        events = []
        subscriber = rospy.Subscriber('/agents/events', CrowdEvent, events.append)
        sender = publisher('/grass/cover/resistance', OccupancyGrid)
        wait_for(lambda: sender.get_num_connections() and subscriber.get_num_connections(),
                 'agent_crowd')
        sender.publish(cover(stamp))
        wait_for(lambda: self.simulation.step() and any(
            event.kind == CrowdEvent.COVER for event in list(events)), 'the cover to act')
        subscriber.unregister()

    # The meadow that has sent it starts afresh too.
    def test_a_reset_forgets_a_cover_of_a_later_time(self):
        first = episode(self.simulation, self.crowd)
        self.send_cover(self.simulation.stamp())
        self.assertEqual(episode(self.simulation, self.crowd), first)
        self.send_cover(rospy.Time(1))  # of a map that does not change
        self.assertNotEqual(episode(self.simulation, self.crowd), first)

    def test_each_step_is_one_tick(self):
        before = self.simulation.reset()['/agents'].header.stamp
        after = self.simulation.step(30)['/agents'].header.stamp
        self.assertEqual(after - before, rospy.Duration(1))
        self.assertEqual(self.simulation.stamp(), after)

    def test_a_topic_without_publisher_is_named(self):
        with self.assertRaisesRegex(VegetationError, 'not connected within 0.2 s: .*forest/state'):
            Simulation({'agents': AgentStates, 'forest/state': ForestState}, timeout=0.2)

    def test_the_loop_of_the_page_runs(self):
        page = open(roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/lockstep.md').read()
        lines = [line[4:] for line in page.splitlines() if line.startswith('    ')]
        with mock.patch('rospy.init_node'), \
                mock.patch('vegetation_sim.Simulation', return_value=self.simulation):
            exec('\n'.join(lines), {})
        self.assertEqual(self.simulation.tick - self.simulation.start, 300)


if __name__ == '__main__':
    rospy.init_node('simulation_test')
    rostest.rosrun('vegetation_sim', 'simulation', SimulationTest)
