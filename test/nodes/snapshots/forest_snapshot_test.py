#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and checkpoints of forest_animator: levels, grabs with their leases, forces to come."""
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Vector3, Vector3Stamped
from vegetation_sim.srv import ApplyForce, Grab, MoveGrab, Release

from forest_rig import Animator, SensorClient, time_of
from given import given
from grab_rig import stamped
from snapshot_rig import START, SnapshotCase, WindSender

TREE, BRANCH = 1, 3


class ForestSnapshot(SnapshotCase):
    PROGRAM = 'forest_animator'
    SCENE, OTHER_SCENE = 'garden', 'clearing'
    TOPICS = 'wind', 'forest/sensors'

    def make_client(self, name, namespace):
        return Animator(name, namespace)

    def prepare(self, node):
        node.wind = WindSender(self, node)
        node.sensor = SensorClient(topic=node.namespace + 'forest/sensors')
        for name, kind in (('grab', Grab), ('move_grab', MoveGrab), ('release', Release),
                           ('apply_force', ApplyForce)):
            setattr(node, name, rospy.ServiceProxy(node.name + '/' + name, kind))

    def grab(self, node, branch, offset, **numbers):
        pose = node.client.tree(TREE).transforms.poses[branch].position
        target = (pose.x + offset, pose.y, pose.z + 0.1)
        answer = node.grab(tree=TREE, branch=branch, along=0.0, target=stamped(target),
                           **given(**numbers))
        self.assertTrue(answer.success, answer.message)
        node.target = target
        return answer.id

    def act(self, node, tick):
        if tick in (3, 90):
            node.wind.send(0 if tick == 3 else 1)
        if tick % 20 == 10 and tick < 200:
            node.sensor.move_to(-3.0, -2.0, 1.0, node.client)
        if tick == 15:
            Client(node.name).update_configuration({'size': 1.1, 'fixed_level': 3})
        if tick == 25:
            self.assertEqual(self.grab(node, BRANCH, 0.3, lease=60.0), 1)
        if tick == 28:
            self.assertEqual(self.grab(node, BRANCH + 1, 0.2, lease=8.0), 2)
        if tick == 40:
            self.assertTrue(node.move_grab(id=1, target=stamped(node.target)).success)
        if tick == 50:  # waits while the state is saved
            force = Vector3Stamped(vector=Vector3(60.0, 0.0, 0.0))
            answer = node.apply_force(tree=0, branch=2, along=0.1, force=force, duration=0.5,
                                      stamp=time_of(START + 100))
            self.assertTrue(answer.success, answer.message)
        if tick == 112:
            self.assertTrue(node.release(id=2).success)
        if tick == 115:
            self.assertEqual(self.grab(node, BRANCH + 2, 0.1, lease=1.0), 3)


if __name__ == '__main__':
    rospy.init_node('forest_snapshot_test')
    rostest.rosrun('vegetation_sim', 'forest_snapshot', ForestSnapshot)
