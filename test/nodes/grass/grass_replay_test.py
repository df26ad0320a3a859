#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A bag of grass/events and the clock replays the run without tf and services (N6)."""
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import roslib.packages
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, PointStamped, TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import GrassColour, GrassColours, GrassCut

from forest_rig import TickClock, scene, stop
from grass_rig import RATE, Feet, Meadow, start_meadow, step, time_of
from replaying import tick_after
from waiting import wait_for
from watched_node import Log, listens, publisher, wait_for_readers

SECONDS = 20
# [s] recorded but not compared, because a recorder that is stopped loses messages in transit
TAIL = 3
TOPICS = ['/clock', '/grass/events']
SPEED = 2  # rate of the replay relative to wall time; a busy machine must keep up
DELAY = 10.0  # [s] of simulated time by which the replay runs behind its events


def lawn_with_a_disc(folder):
    """Returns a copy of the scenario lawn, with a disc of colour that moves."""
    for name in 'lawn.yaml', 'lawn_density.pgm':
        shutil.copy(os.path.join(os.path.dirname(scene('lawn')), name), folder)
    with open(os.path.join(folder, 'lawn.yaml'), 'a') as file:
        file.write('  colours: [{x: 3.0, y: 4.0, radius: 2.0, velocity_x: 0.5}]\n')
    return file.name


def discs_of(log):
    """Returns the discs of colour by the stamps at which they have their places."""
    return {m.header.stamp: m.colours for m in log.messages}


class GrassReplay(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.bag = os.path.join(self.folder.name, 'grass.bag')
        self.scenario = lawn_with_a_disc(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def drive(self, tick):
        """Moves a wheel on a circle and a walker, and sends a few requests."""
        frame = TransformStamped(child_frame_id='wheel')
        frame.header.frame_id, frame.header.stamp = 'map', time_of(self.clock.tick + 1)
        angle = 0.8 * tick / RATE
        frame.transform.translation.x = 6.0 * math.cos(angle)
        frame.transform.translation.y = 6.0 * math.sin(angle)
        frame.transform.rotation.w = 1.0
        self.tf.publish(TFMessage([frame]))
        self.feet.send(step('walker', -10.0 + tick / RATE, math.sin(tick / 20.0)))
        second = tick / RATE
        if second == 4:
            self.call(self.grass.tread(points=[Point(-15, -15, 0), Point(15, -10, 0)]))
        if second in (6, 16):
            corners = [Point(second - 20 + x, y, 0) for x, y in ((0, 0), (4, 0), (5, 3), (1, 3))]
            self.call(self.grass.cut(cut=GrassCut(outline=corners, height=0.05)))
        if second in (5, 12):
            disc = GrassColour(x=second, radius=3.0, colour=0.5, weight=2.0, velocity_y=0.25)
            self.call(self.grass.set_colours(colours=[disc]))
        if second == 8:
            self.server.update_configuration({'tread_radius': 0.2, 'tread_recovery': 20.0})
        if second == 11:
            self.call(self.grass.clear(centre=PointStamped(point=Point(0, -12, 0)), radius=4.0))
        if second == 14:
            self.call(rospy.ServiceProxy('/grass_field/reset', Trigger)())

    def call(self, answer):
        self.assertTrue(answer.success, answer.message)

    def live_run(self):
        """Records a run. Returns its hashes and its discs of colour by stamp."""
        process = start_meadow('/grass_field', {}, scenario=self.scenario, key_frame_period=0.2,
                               sources=[{'frame': 'wheel', 'radius': 0.15, 'recovery': 12.0}])
        self.addCleanup(stop, process)
        colours = Log('/grass/colours', GrassColours)
        self.grass, self.clock = Meadow(), TickClock(1000 * RATE)
        self.grass.wait_until_up()
        wait_for(colours.connected, colours.topic)
        self.tf, self.feet = publisher('/tf', TFMessage), Feet(self.grass)
        wait_for_readers('/tf', self.grass.process)
        self.server = Client('/grass_field', timeout=30)
        record = roslib.packages.find_node('rosbag', 'record')[0]
        recorder = subprocess.Popen([record, '-q', '-O', self.bag, '__name:=recorder'] + TOPICS)
        for topic in TOPICS:
            wait_for(lambda: listens('/recorder', topic), 'the recorder of ' + topic)
        self.clock.run(1, self.grass)
        wait_for(lambda: os.path.exists(self.bag + '.active'), 'the recorder to begin')
        for tick in range(SECONDS * RATE):
            self.drive(tick)
            self.clock.run(1, self.grass)
        hashes = self.grass.hashes()
        self.clock.run(TAIL * RATE, self.grass)
        stop(recorder)
        colours.wait(lambda all: len(all) >= 3, 'the discs of the scenario and of two requests')
        self.grass.close()
        colours.close()
        stop(process)
        return hashes, discs_of(colours)

    def replay(self, last):
        """Runs another node that receives only the bag. Returns its hashes and its discs."""
        process = start_meadow('/replay/grass_field', {}, scenario=self.scenario, replay=True,
                               replay_delay=DELAY, key_frame_period=0.2)
        colours = Log('/replay/grass/colours', GrassColours)
        try:
            grass = Meadow('/replay/grass_field', '/replay/')
            grass.expect_replay()
            grass.wait_until_up()
            wait_for(colours.connected, colours.topic)
            subprocess.run(['rosbag', 'play', '-q', '--clock', '-r', str(SPEED), '-d', '1', self.bag,
                            '--topics', '/grass/events', '/grass/events:=/replay/grass/events'],
                           check=True, timeout=100, stdout=subprocess.DEVNULL)
            # The clock of the bag ends before the delay has passed, so the test continues it.
            end = tick_after(self.bag, ['/grass/events'])
            for tick in range(1, int((DELAY + 1) * RATE)):
                self.clock.show(end + tick)
            grass.state.wait(lambda all: all and all[-1].header.stamp >= last, 'the end')
            refused = grass.clear()
            self.assertFalse(refused.success)
            self.assertIn('a replay follows its recorded events only', refused.message)
            colours.wait(lambda all: len(all) >= 4, 'the discs of its first tick and three events')
            grass.close()
            colours.close()
            return grass.hashes(), discs_of(colours)
        finally:
            stop(process)

    def test_a_bag_replays_the_run(self):
        live, discs = self.live_run()
        print('bag of %d s: %.2f MB' % (SECONDS, os.path.getsize(self.bag) / 1e6))
        again, discs_again = self.replay(max(live))
        common = sorted(set(live) & set(again))
        self.assertGreater(len(common), 4 * SECONDS)
        self.assertGreater(len({live[s] for s in common}), 3 * SECONDS, 'little happened')
        self.assertEqual([s for s in common if again[s] != live[s]], [])
        # S2-18: each list is in force from its own tick on, at its place. The replay begins at an
        # earlier tick, with the discs of the scenario.
        self.assertEqual(len(discs), 3)
        self.assertEqual({s: d for s, d in discs_again.items() if s >= min(discs)}, discs)


if __name__ == '__main__':
    rospy.init_node('grass_replay_test')
    rostest.rosrun('vegetation_sim', 'grass_replay', GrassReplay)
