#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A replayed bag of topics gives the same states, and hashes of the world, at every tick (N6)."""
import os
import subprocess
import tempfile
import unittest

import roslib.packages
import rosnode
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, PointStamped, TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ForestEvent, WindPrimitive
from vegetation_sim.srv import ApplyForce, CutBranch, Grab, MoveGrab, Release, SetWindPrimitive

from forest_rig import RATE, Animator, SensorClient, TickClock, scene, stop, time_of
from replaying import replay
from waiting import wait_for
from watched_node import listens, publisher, wait_for_readers

SECONDS = 60
# [s] recorded but not compared, because a recorder that is stopped loses messages in transit
TAIL = 5
TOPICS = ['/clock', '/wind', '/forest/sensors', '/forest/layout', '/forest/state', '/forest/events']


class ForestReplay(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.bag = os.path.join(self.folder.name, 'forest.bag')

    def tearDown(self):
        self.folder.cleanup()

    def edit(self, second):
        """Changes settings as users do during a run."""
        self.hold(second)
        if second == 20:
            self.server.update_configuration({'size': 0.9, 'transition': 0.4})
        if second == 30:
            self.assertTrue(rospy.ServiceProxy('/forest_animator/reset', Trigger)().success)
        if second == 40:
            blow = WindPrimitive(name='whirl_west', kind=WindPrimitive.DISK, radius=40.0, omega=3.0)
            blow.velocity.x, blow.orbit_period = 6.0, 30.0
            answer = rospy.ServiceProxy('/wind_broadcaster/set_primitive', SetWindPrimitive)(blow)
            self.assertTrue(answer.success, answer.message)

    def hold(self, second):
        """Grabs, moves, releases and pushes branches; later a gripper whose frame is no longer
        published holds one."""
        def call(name, service, **request):
            answer = rospy.ServiceProxy('/forest_animator/' + name, service)(**request)
            self.assertTrue(answer.success, answer.message)
            return answer

        def near(place, up):
            return PointStamped(point=Point(place.x + 0.1, place.y, place.z + up))
        if second == 5:
            self.first = call('grab', Grab, tree=11, branch=9, has_lease=True, lease=3.0,
                              target=near(self.forest.tree(11).transforms.poses[9].position, 0.1))
        if second == 7:
            call('move_grab', MoveGrab, id=self.first.id, target=near(self.first.point, 0.3))
        if second == 8.5:
            call('release', Release, id=self.first.id)
        if second == 10:
            force = call('apply_force', ApplyForce, tree=12, branch=7, duration=0.4)
            self.assertEqual(force.branch, 7)
        if second == 12:
            self.assertEqual(call('cut_branch', CutBranch, tree=14, branch=6).branch, 6)
        if 44 <= second < 48:
            if second == 44:
                self.hand = self.forest.tree(13).transforms.poses[8].position
                wait_for_readers('/tf', '/forest_animator')
            frame = TransformStamped(child_frame_id='hand')
            frame.header.frame_id, frame.header.stamp = 'map', time_of(self.clock.tick)
            at = frame.transform.translation
            at.x, at.y, at.z = self.hand.x + 0.02 * (second - 44), self.hand.y, self.hand.z
            frame.transform.rotation.w = 1.0
            self.frames.publish([frame])
        if second == 45:
            call('grab', Grab, tree=13, branch=8, frame='hand', keep_offset=True,
                 has_lease=True, lease=1.0)

    def live_run(self):
        """Records the forest while a sensor flies through it. Returns the states by stamp."""
        forest, clock, sensor = Animator(), TickClock(1000 * RATE), SensorClient()
        self.forest, self.clock, self.frames = forest, clock, publisher('/tf', TFMessage)
        forest.wait_until_up('/wind', '/forest/sensors')
        self.server = Client('/forest_animator', timeout=30)
        record = roslib.packages.find_node('rosbag', 'record')[0]
        recorder = subprocess.Popen([record, '-q', '-O', self.bag, '__name:=recorder'] + TOPICS)
        sensor.move_to(-60.0, -10.0, 4.0, forest)
        for topic in TOPICS:
            wait_for(lambda: listens('/recorder', topic), 'the recorder of ' + topic)
        clock.run(1, forest)
        wait_for(lambda: os.path.exists(self.bag + '.active'), 'the recorder to begin')
        for half in range(2 * SECONDS):
            self.edit(half / 2)
            sensor.move_to(-60.0 + half, -10.0, 4.0, forest)
            clock.run(RATE // 2, forest)
        self.assertEqual(len(forest.state.messages), SECONDS * RATE + 1)
        winds = [m.wind_hash for m in forest.state.messages]
        self.assertNotEqual(winds[30 * RATE], winds[-1])
        forest.layout.wait(lambda all: len(all) == 2, 'the other layout')
        kinds = {e.kind for e in forest.events.messages}
        self.assertLessEqual({ForestEvent.GRAB, ForestEvent.MOVE, ForestEvent.RELEASE,
                              ForestEvent.FORCE, ForestEvent.CUT}, kinds)
        cut = [t.tree for m in forest.state.messages for t in m.trees if t.broken]
        self.assertGreater(cut.count(14), 5)
        held = [m.header.stamp.to_sec() for m in forest.state.messages
                if any(t.tree == 13 and t.promoted for t in m.trees)]
        self.assertGreater(len(held), RATE)
        changes = sum(len(m.trees) for m in forest.state.messages if not m.key_frame)
        hashes = len(set(forest.hashes().values()))
        print('%d different hashes, %d trees in deltas' % (hashes, changes))
        self.assertGreater(hashes, 2 * RATE, 'little happened to the world')
        self.assertGreater(changes, 4 * RATE, 'little was perceived')
        states = forest.states()
        clock.run(TAIL * RATE, forest)
        stop(recorder)
        forest.close()
        return states, clock

    def test_a_bag_replays_the_run(self):
        live, clock = self.live_run()
        print('bag of %d s: %.2f MB' % (SECONDS, os.path.getsize(self.bag) / 1e6))
        rosnode.kill_nodes(['/wind_broadcaster', '/forest_animator'])
        again = replay(self.bag, clock, scene('forest'), max(live))
        self.assertEqual([s for s in sorted(live) if again.get(s) != live[s]], [])


if __name__ == '__main__':
    rospy.init_node('forest_replay_test')
    rostest.rosrun('vegetation_sim', 'forest_replay', ForestReplay)
