#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""With respawn:=true, nodes that are killed start again."""
import os
import signal
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest

from waiting import wait_for
from watched_node import slave

NODES = '/wind_broadcaster', '/forest_animator'


def process_of(node):
    """Returns the number of a node's process; None if no node of this name answers."""
    try:
        return slave(node).getPid('/respawn_test')[2]
    except (rosgraph.MasterException, OSError, xmlrpc.client.Error):
        return None


class Respawn(unittest.TestCase):
    def test_killed_nodes_start_again(self):
        before = {node: wait_for(lambda node=node: process_of(node), node) for node in NODES}
        for process in before.values():
            os.kill(process, signal.SIGKILL)
        for node, process in before.items():
            wait_for(lambda node=node, old=process: process_of(node) not in (None, old),
                     node + ' to start again')


if __name__ == '__main__':
    rospy.init_node('respawn_test')
    rostest.rosrun('vegetation_sim', 'respawn', Respawn)
