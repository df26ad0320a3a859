#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A scanner that is killed and started again measures what one that was never killed does: it needs
no checkpoint. The environment variable CHECKPOINT_KILLS says how often it is killed."""
import os
import signal
import unittest
from random import Random

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import SensorInterest

from forest_rig import RATE, Animator, TickClock, scene, start_animator, start_node, stop
from scan_rig import Scanner
from waiting import wait_for
from watched_node import Log

KILLS = int(os.environ.get('CHECKPOINT_KILLS', 0)) or 3
LIDAR = dict(rate=10, delay=0.1, noise=0.02, dropout=0.1, tolerance=0.02, rings=16, columns=180,
             elevation_low=-0.4, elevation_high=0.8, range_max=30.0)
INPUTS = 'wind', 'forest/layout', 'forest/state', 'forest/sensors'
ANSWER = 3 * RATE // 2  # ticks after which a scanner that starts has a complete state


class Lidar:
    """A scanner of the one forest, in a namespace of its own."""

    def __init__(self, name):
        self.space = '/%s/' % name
        self.name = self.space + 'vegetation_scanner'
        self.start()
        self.scanner = Scanner(self.name, self.space)
        self.wait()

    def start(self):
        self.process = start_node('vegetation_scanner', self.name,
                                  {name: '/' + name for name in INPUTS}, **LIDAR)

    def wait(self):
        self.scanner.wait_until_up('/wind', '/forest/layout', '/forest/state')
        wait_for(lambda: self.scanner.has_frame('lidar'), 'the frame of the sensor')

    def kill(self):
        stop(self.process, signal.SIGKILL)
        self.start()
        self.scanner.reconnect()
        self.wait()

    def clouds(self):
        return {m.header.stamp: bytes(m.data) for m in self.scanner.points.messages}


class ScanKill(unittest.TestCase):
    def setUp(self):
        mast = TransformStamped(child_frame_id='lidar')
        mast.header.frame_id, mast.transform.translation.z = 'map', 1.2
        mast.transform.rotation.w = 1.0
        self.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        self.frames.publish([mast])
        self.clock = TickClock(1000 * RATE)
        self.forest_process = start_animator('/forest_animator', {}, scenario=scene('clearing'))
        self.forest = Animator('/forest_animator', '/')
        self.forest.wait_until_up('/wind')
        self.lidars = self.steady, self.killed = Lidar('steady'), Lidar('killed')

    def tearDown(self):
        for process in (self.forest_process, *(lidar.process for lidar in self.lidars)):
            stop(process)

    def run_ticks(self, count):
        for _ in range(count):
            self.clock.run(1, self.forest)
            for lidar in self.lidars:
                lidar.scanner.settle()

    def test_a_killed_scanner_measures_what_another_one_does(self):
        interest = Log('/forest/sensors', SensorInterest)
        wait_for(interest.connected, interest.topic)
        self.clock.begin(self.forest)
        self.run_ticks(2 * RATE)
        random = Random(1)
        compared = 0
        for _ in range(KILLS):
            self.killed.kill()
            begun = self.clock.tick
            self.run_ticks(ANSWER + random.randrange(RATE))
            newest = max(self.steady.clouds())
            wait_for(lambda: newest in self.killed.clouds(), 'the newest sweep')
            steady, killed = self.steady.clouds(), self.killed.clouds()
            stamps = [s for s in steady if s.to_sec() > begun / RATE]
            both = [s for s in stamps if s in killed]
            self.assertGreater(len(both), 3, 'sweeps of a scanner that was started again')
            self.assertEqual([s for s in both if steady[s] != killed[s]], [])
            self.assertIn(newest, both)
            compared += len(both)
        self.assertGreater(len(set(steady.values())), len(steady) // 2, 'the scene moves')
        print('vegetation_scanner: %d equal clouds after %d kills' % (compared, KILLS))


if __name__ == '__main__':
    rospy.init_node('scan_kill_test')
    rostest.rosrun('vegetation_sim', 'scan_kill', ScanKill)
