#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shards that start late, die and come back from their checkpoints are one world with single nodes
that run on; nodes that do not fit the shards that are there do not start."""
import os
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

import roslib.packages
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from vegetation_sim.msg import ErrorCode, ForestLayout, ForestState, ShardNode
from vegetation_sim.srv import GetTree

from forest_rig import start_node, stop
from sharded_world import Requests, World
from waiting import DEADLINE, wait_for
from watched_node import Log, listens

FOLDER = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(FOLDER, 'hosts.yaml')
TYPES = {'forest': 'forest_animator', 'grass': 'grass_field'}
SHARDS = 2
SETTLING = 60  # ticks until the trees of a new node have their levels


def parameters(kind, index, count, **more):
    with open(os.path.join(FOLDER, 'hosts_%s.yaml' % kind), encoding='utf-8') as file:
        out = yaml.safe_load(file)
    out.update(scenario=SCENE, shard=dict(index=index, count=count, wait=2.0), frame_wait=1.0)
    out.update(more)
    return out


class ShardDeaths(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder, cls.processes = tempfile.mkdtemp(), {}
        cls.processes['/wind_broadcaster'] = start_node('wind_broadcaster', '/wind_broadcaster', {}, scenario=SCENE)
        for kind in TYPES:
            cls.start('/whole/%s_all' % kind, kind, 0, 1)
            cls.start_shard(kind, 0)
        cls.world = World(SHARDS, alive=1, others=2)
        cls.world.begin += 10 * SETTLING
        cls.run_ticks(2)
        cls.requests = Requests(cls.world)

    @classmethod
    def tearDownClass(cls):
        for process in cls.processes.values():
            stop(process, signal.SIGKILL)
        shutil.rmtree(cls.folder)

    @classmethod
    def start(cls, name, kind, index, count, **more):
        cls.processes[name] = start_node(TYPES[kind], name, {'wind': '/wind', 'tread': '/tread'},
                                         **parameters(kind, index, count, **more))

    @classmethod
    def start_shard(cls, kind, index):
        cls.start('/%s_%d' % (kind, index), kind, index, SHARDS, snapshot_folder=cls.folder,
                  checkpoint_period=0.4, checkpoint=True)

    def join_shard(self, index):
        """Starts the nodes of a shard, and waits until they hear all."""
        for kind in TYPES:
            self.start_shard(kind, index)
            name = '/%s_%d' % (kind, index)
            rospy.wait_for_service(name + '/tf2_frames', DEADLINE)
            for topic in ['/clock', '/wind', '/tf'] + ['/tread'] * (kind == 'grass'):
                wait_for(lambda n=name, t=topic: listens(n, t), '%s to subscribe to %s' % (name, topic))
            for states in ('/%s/state' % kind,):
                wait_for(lambda n=name, t=states: n in self.sources(t), name)
        self.world.alive = SHARDS

    @staticmethod
    def sources(topic):
        state = rospy.get_master().getSystemState()[2][0]
        return [node for name, nodes in state if name == topic for node in nodes]

    def kill_shard(self, index):
        for kind in TYPES:
            stop(self.processes['/%s_%d' % (kind, index)], signal.SIGKILL)
        self.world.alive -= 1

    @classmethod
    def run_ticks(cls, ticks, act=None):
        for age in range(ticks):
            cls.world.show_frames()
            if act:
                act(age)
            cls.world.run_tick()

    def act(self, age):
        self.world.walk()
        self.requests.act(age)

    def warning(self, node, words):
        """Waits for a diagnostic of a node with these words."""
        log = Log('/diagnostics', DiagnosticArray)
        log.wait(lambda all: any(words in s.message for m in all for s in m.status
                                 if s.name.startswith(node.lstrip('/') + ': ')), words)
        log.close()

    def check_equal(self, least):
        """The hashes are equal at all ticks of both, of which there are at least so many."""
        for kind in TYPES:
            both, equal, hashes = self.world.compare(kind)
            self.assertEqual(both, equal, kind)
            self.assertGreaterEqual(hashes, least, kind)

    def test_1_a_late_shard_joins(self):
        for kind in TYPES:
            self.warning('/%s_0' % kind, 'no node animates these of the 2 shards: 1')
        answer = rospy.ServiceProxy('/forest_0/get_tree', GetTree)(tree=15)
        self.assertEqual(answer.message, 'shard 1 of 2 is animated by no node')
        self.join_shard(1)
        self.run_ticks(2)
        wait_for(self.world.is_joined, 'shards to find each other')
        self.run_ticks(SETTLING)
        self.world.begin = self.world.tick
        self.run_ticks(80, self.act)
        self.check_equal(60)

    def test_2_a_killed_shard_continues_from_its_checkpoint(self):
        """The clock stands still meanwhile."""
        self.kill_shard(1)
        for kind in TYPES:
            self.warning('/%s_0' % kind, 'no message for 3 s from these shards: 1 (/%s_1)' % kind)
        answer = rospy.ServiceProxy('/forest_0/get_tree', GetTree)(tree=15)
        self.assertEqual(answer.error_code, ErrorCode.NOT_AVAILABLE)
        self.assertIn('shard 1 of 2, /forest_1, does not answer', answer.message)
        self.join_shard(1)
        self.run_ticks(1)
        wait_for(self.world.is_joined, 'shards to find each other')
        self.run_ticks(60, self.act)
        self.check_equal(110)

    def test_3_a_shard_catches_up(self):
        """The clock goes on for a third of a second without inputs while the shard is down."""
        before = len(self.world.compare('forest')[0])
        self.world.show_frames = lambda: None  # ticks that have no transform of the robot
        self.run_ticks(20)
        self.kill_shard(0)
        self.run_ticks(10)
        self.join_shard(0)
        self.run_ticks(1)
        del self.world.show_frames
        wait_for(self.world.is_joined, 'shards to find each other')
        self.run_ticks(60, self.act)
        self.check_equal(160)
        self.assertGreater(len(self.world.compare('forest')[0]), before + 80)

    def refusal(self, kind, name, index, count, namespace='/', **more):
        """Starts a node, which must end with an error; returns that."""
        rospy.set_param(namespace + name, parameters(kind, index, count, **more))
        done = subprocess.run(
            [roslib.packages.find_node('vegetation_sim', TYPES[kind])[0], '__name:=' + name, '__ns:=' + namespace],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(TYPES[kind] + ' refuses to start', done.stderr)
        return re.sub(r'\x1b\[\d+m', '', done.stderr)

    def test_4_nodes_that_do_not_fit_do_not_start(self):
        layouts, reports = Log('/forest/layout', ForestLayout), Log('/diagnostics', DiagnosticArray)
        layouts.wait(lambda all: len(all) >= SHARDS, 'layouts')
        for kind in TYPES:
            first = '/%s_[01] is shard [01] of 2' % kind
            other = os.path.join(os.path.dirname(FOLDER), 'scenarios', 'clearing.yaml')
            for name, index, count, more, words in (
                    ('wrong_count', 2, 3, {}, r' with shard/count = 2; allowed is that of this node, \S+, 3'),
                    ('twice', 1, 2, {}, 'is shard 1 of 2, as this node, /twice, is; a shard has one node'),
                    ('wrong_scene', 1, 2, dict(scenario=other), r" with the hash of the scenario's (layout|terrain) = \d+"),
                    ('wrong_rate', 1, 2, dict(state_rate=20), ' with state_rate = 30; allowed is that of this node, '
                                                              '/wrong_rate, 20'),
                    ('all', 0, 1, {}, 'but this node, /all, animates the whole; allowed are nodes of shards only')):
                refusal = self.refusal(kind, name, index, count, **more)
                self.assertRegex(refusal, first)
                self.assertRegex(refusal, words)
        # Those that are there have said whom they did not take.
        reports.wait(lambda all: any('/wrong_rate is shard 1 of 2' in s.message for m in all for s in m.status),
                     '/wrong_rate')
        self.run_ticks(20, self.act)
        self.check_equal(170)
        self.assertEqual(len({m.hash for m in layouts.messages}), 1)

    def test_5_another_version_does_not_start(self):
        shards = rospy.Publisher('/newer/forest/shards', ShardNode, queue_size=1, latch=True)
        shards.publish(ShardNode(node='/newer/forest_0', shard=0, shards=2, open=True, started=rospy.Time(1),
                                 messages='0123 4567', rate=30))
        own = '%s %s' % (ForestLayout._md5sum, ForestState._md5sum)
        self.assertIn('/newer/forest_0 is shard 0 of 2 with the version of messages = 0123 4567; allowed is that '
                      'of this node, /newer/forest_1, ' + own, self.refusal('forest', 'forest_1', 1, 2, '/newer/'))

    def test_6_a_node_of_the_whole_names_shards_that_start_beside_it(self):
        shards = rospy.Publisher('/whole/forest/shards', ShardNode, queue_size=1, latch=True)
        shards.publish(ShardNode(node='/whole/forest_0', shard=0, shards=2, rate=30))
        self.warning('/whole/forest_all', '/whole/forest_0 is shard 0 of 2, but this node, /whole/forest_all, animates')


if __name__ == '__main__':
    rospy.init_node('shard_deaths_test')
    rostest.rosrun('vegetation_sim', 'shard_deaths', ShardDeaths)
