#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a lidar measures does not depend on whether a display looks at the trees, and the state of
the world depends on neither (N1): four forests in one wind without a listener, with a lidar, and
with the same lidar and a viewer that looks away or at the trees."""
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ScanReport, SensorInterest

from forest_rig import (RATE, Animator, TickClock, ViewerClient, scene, start_animator, start_node,
                        stop, time_of)
from scan_rig import Scanner, cloud_of
from waiting import wait_for
from watched_node import Log

SECONDS = 8
WOOD = ScanReport.TRUNK, ScanReport.BRANCH
LIDAR = dict(rate=10, delay=0.1, noise=0.02, tolerance=0.02, rings=24, columns=240,
             elevation_low=-0.4, elevation_high=0.8, range_max=30.0)


class Clearing:
    """A forest in a namespace of its own."""

    def __init__(self, name):
        self.space = '/%s/' % name
        self.processes = [start_animator(self.space + 'forest_animator', {'wind': '/wind'},
                                         scenario=scene('clearing'))]
        self.forest = Animator(self.space + 'forest_animator', self.space)
        self.forest.wait_until_up('/wind')

    def settle(self):
        self.forest.settle()


class SensedClearing(Clearing):
    """A forest with a lidar."""

    def __init__(self, name):
        super().__init__(name)
        space = self.space
        self.processes.append(start_node('vegetation_scanner', space + 'vegetation_scanner',
                                         {'wind': '/wind'}, **LIDAR))
        self.scanner = Scanner(space + 'vegetation_scanner', space)
        self.interest = Log(space + 'forest/sensors', SensorInterest)
        self.scanner.wait_until_up('/wind', space + 'forest/layout', space + 'forest/state')
        wait_for(self.interest.connected, self.interest.topic)
        self.forest.wait_until_up(space + 'forest/sensors')

    def settle(self):
        self.scanner.settle()
        super().settle()

    def clouds(self):
        return {m.header.stamp: bytes(m.data) for m in self.scanner.points.messages}


class ScanWatched(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        mast = TransformStamped(child_frame_id='lidar')
        mast.header.frame_id, mast.transform.translation.z = 'map', 1.2
        mast.transform.rotation.w = 1.0
        cls.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.mast = mast
        cls.clock = TickClock(1000 * RATE)  # Nodes wait for its topic.
        cls.sensed = cls.unwatched, cls.behind, cls.watched = [
            SensedClearing(name) for name in ('unwatched', 'behind', 'watched')]
        cls.deaf = Clearing('deaf')
        cls.all = cls.deaf, *cls.sensed

    @classmethod
    def tearDownClass(cls):
        for clearing in cls.all:
            for process in clearing.processes:
                stop(process)

    def run_tick(self, clock):
        """Advances a tick. Returns when all sensors have announced themselves."""
        clock.run(1, *(c.forest for c in self.all))
        for clearing in self.all:
            clearing.settle()

    def test_listeners_change_neither_the_world_nor_what_a_lidar_measures(self):
        clock = self.clock
        clock.begin(*(c.forest for c in self.all))
        begun = time_of(clock.tick)  # The wind reached the forests at ticks of their own.
        # All sensors announce themselves first at the same tick: the next one.
        for clearing in self.all:
            clearing.settle()
        self.frames.publish([self.mast])
        for clearing in self.sensed:
            wait_for(lambda: clearing.scanner.has_frame('lidar'), 'the frame of the sensor')
        behind, watched = ViewerClient('eye', '/behind/viewer'), ViewerClient('eye', '/watched/viewer')
        behind.message.pose.orientation.w, behind.message.pose.orientation.z = 0.0, 1.0
        for tick in range(SECONDS * RATE):
            if tick % (RATE // 2) == 0:
                behind.move_to(-30.0, 0.0, 2.0, self.behind.forest)
                watched.move_to(-30.0, 0.0, 2.0, self.watched.forest)
            self.run_tick(clock)
        hashes = [c.forest.hashes() for c in self.all]
        stamps = sorted(s for s in hashes[0] if s > begun)
        self.assertEqual(len(stamps), SECONDS * RATE)
        for other in hashes[1:]:
            self.assertEqual([other[s] for s in stamps], [hashes[0][s] for s in stamps])
        clouds = [c.clouds() for c in self.sensed]
        sweeps = sorted(set(clouds[0]) & set(clouds[1]) & set(clouds[2]))
        self.assertGreater(len(sweeps), 10 * (SECONDS - 2))
        for other in clouds[1:]:
            self.assertEqual([s for s in sweeps if other[s] != clouds[0][s]], [])
        print('%d sweeps and %d hashes are equal' % (len(sweeps), len(stamps)))
        self.expect_a_lively_scene()

    # Otherwise equal clouds would show nothing: the trees move, displays draw them differently, and
    # the lidar gets more than the fixed level.
    def expect_a_lively_scene(self):
        points = [cloud_of(m) for m in self.unwatched.scanner.points.messages[-2:]]
        wood = [p[numpy.isin(p['label'], WOOD)] for p in points]
        self.assertGreater(len(wood[0]), 50)
        self.assertNotEqual(wood[0].tobytes(), wood[1].tobytes())
        self.assertEqual([self.behind.forest.view_level(tree) for tree in range(4)], [0] * 4)
        self.assertGreater(self.watched.forest.view_level(0), 2)
        self.assertGreater(self.behind.forest.level(0), 2)
        self.assertEqual(self.deaf.forest.level(0), 2)


if __name__ == '__main__':
    rospy.init_node('scan_watched_test')
    rostest.rosrun('vegetation_sim', 'scan_watched', ScanWatched)
