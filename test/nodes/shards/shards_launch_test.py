#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""shards.launch starts all shards of a scenario, which find each other and publish their shares."""
import subprocess
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from vegetation_sim.msg import ForestState, GrassState, ShardNode
from vegetation_sim.srv import FindTrees, GetTree

from waiting import wait_for
from watched_node import Log

COUNT = 3


def ask_for_trees(shard, trees):
    """Returns the answers of a shard, or [] if it refuses one."""
    get_tree = rospy.ServiceProxy('/forest_%d/get_tree' % shard, GetTree)
    answers = [get_tree(tree=tree) for tree in trees]
    return answers if all(answer.success for answer in answers) else []


class ShardsLaunch(unittest.TestCase):
    def test_all_shards_run_and_answer_for_each_other(self):
        for part, state in (('forest', ForestState), ('grass', GrassState)):
            found = Log('/%s/shards' % part, ShardNode)
            found.wait(lambda all: len({m.shard for m in all}) == COUNT, 'all shards')
            nodes = {m.shard: m for m in found.messages}
            self.assertEqual({i: (m.node, m.shards) for i, m in nodes.items()},
                             {i: ('/%s_%d' % (part, i), COUNT) for i in range(COUNT)})
            Log('/%s/state' % part, state).wait(
                lambda all: {m.shard for m in all} == set(range(COUNT)), 'states of all')
        people = Log('/crowd/shards', ShardNode)
        people.wait(lambda all: len({m.shard for m in all}) == COUNT, 'shards of the crowd')
        self.assertEqual([rospy.get_param('/crowd_%d/tread_ahead' % i) for i in range(COUNT)], [3] * COUNT)
        rospy.wait_for_service('/forest_0/get_tree', timeout=60.0)
        trees = rospy.ServiceProxy('/forest_0/find_trees', FindTrees)(all=True, limit=1).total
        self.assertGreater(trees, COUNT)
        hashes = set()
        for shard in range(COUNT):
            # The node may hear of the others later than this test does.
            answers = wait_for(lambda i=shard: ask_for_trees(i, (0, trees // 2, trees - 1)),
                               'shard %d to find the others' % shard)
            hashes.add(tuple(a.skeleton_hash for a in answers))
        self.assertEqual(len(hashes), 1)

    def test_the_shards_of_another_part_are_no_rivals(self):
        reports = Log('/diagnostics', DiagnosticArray)
        reports.wait(lambda all: {s.name.split(':')[0] for m in all for s in m.status} >= {
            'crowd_%d' % i for i in range(COUNT)}, 'reports of the crowd')
        self.assertFalse([s.message for m in reports.messages for s in m.status if 'publishers of' in s.message])

    # Two nodelets of a manager are one process to the master.
    def test_a_second_nodelet_of_the_same_shard_is_not_loaded(self):
        found = Log('/twins/forest/shards', ShardNode)
        first = self.load('first')
        found.wait(lambda all: all, 'the first nodelet')
        self.assertNotEqual(self.load('second').wait(timeout=60.0), 0)
        self.assertIsNone(first.poll())

    def load(self, name):
        """Returns the process that loads a forest into the manager, and ends if that fails."""
        loader = subprocess.Popen(['rosrun', 'nodelet', 'nodelet', 'load', 'vegetation_sim/forest_animator', '/manager',
                                   '__name:=' + name, '__ns:=/twins'])
        self.addCleanup(loader.wait)
        self.addCleanup(loader.terminate)
        return loader


if __name__ == '__main__':
    rospy.init_node('shards_launch_test')
    rostest.rosrun('vegetation_sim', 'shards_launch', ShardsLaunch)
