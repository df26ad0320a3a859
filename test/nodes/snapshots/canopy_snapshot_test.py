#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and checkpoints of canopy_animator: flow, leaves, wind, viewer and cut
plants."""
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point
from vegetation_sim.msg import GrassCut
from vegetation_sim.srv import CutPlants

from canopy_rig import Leaves
from forest_rig import ViewerClient
from snapshot_rig import SnapshotCase, WindSender


class CanopySnapshot(SnapshotCase):
    PROGRAM = 'canopy_animator'
    SCENE, OTHER_SCENE = 'garden', 'grove'
    TOPICS = 'wind', 'viewer'

    def make_client(self, name, namespace):
        return Leaves(name, namespace)

    def prepare(self, node):
        node.wind = WindSender(self, node)
        node.viewer = ViewerClient(topic=node.namespace + 'viewer')

    def act(self, node, tick):
        if tick in (3, 90):
            node.wind.send(0 if tick == 3 else 1)
        if tick in (10, 40, 70):
            node.viewer.move_to(-5.0, 0.1 * tick, 1.5, node.client)
        if tick == 30:
            disc = GrassCut(outline=[Point()], radius=100.0, height=0.5)
            answer = rospy.ServiceProxy(node.name + '/cut', CutPlants)(cut=disc)
            self.assertGreater(answer.plants, 0)
            Client(node.name).update_configuration({'rightward': 2.0, 'frequency': 3.0})


if __name__ == '__main__':
    rospy.init_node('canopy_snapshot_test')
    rostest.rosrun('vegetation_sim', 'canopy_snapshot', CanopySnapshot)
