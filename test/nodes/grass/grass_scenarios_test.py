#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the meadow scenarios of the demo without rviz: the rolling stone (S2-29), the robot and people
on a hillside leave tracks, the mower cuts."""
import math
import signal
import subprocess
import threading
import unittest

import rosnode
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry

from forest_rig import TickClock
from grass_rig import RATE, Meadow
from waiting import DEADLINE, wait_for
from watched_node import Log

NODES = {'meadow': ['/stone', '/grass_field', '/wind_broadcaster'],
         'hills': ['/agent_crowd', '/forest_animator', '/grass_field', '/wind_broadcaster'],
         'mowing': ['/mower', '/grass_field', '/wind_broadcaster'],
         'meadow_robot': ['/robot', '/driver', '/grass_field', '/wind_broadcaster']}


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
        self.run_until(lambda: len({t.source for t in self.treads()}) > 30, 'people')
        self.run_until(lambda: len(self.treads()) > 2000, 'people who walk')
        down = [t.position for t in self.treads()]
        self.clock.run(1, self.meadow)
        self.assertGreater(max(p.z for p in down) - min(p.z for p in down), 6.0)
        samples = self.meadow.samples([(p.x, p.y) for p in down])
        self.assertLess(max(abs(s.position.z - p.z) for s, p in zip(samples, down)), 1e-6)
        self.assertGreater(min(s.tilt for s in samples if s.inside), 1.0)

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
