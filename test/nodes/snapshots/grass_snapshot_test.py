#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and checkpoints of grass_field: trodden ground, sources, paths to come."""
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, PointStamped
from std_msgs.msg import Header
from vegetation_sim.msg import GrassColour, GrassCut, TreadLaw

from forest_rig import time_of
from grass_rig import Feet, Meadow, step, wide_stroke
from snapshot_rig import START, SnapshotCase
from waiting import wait_for


def points(*places):
    return [Point(x, y, 0.0) for x, y in places]


class GrassSnapshot(SnapshotCase):
    PROGRAM = 'grass_field'
    SCENE, OTHER_SCENE = 'garden', 'lawn'
    TOPICS = 'tread',

    def make_client(self, name, namespace):
        return Meadow(name, namespace)

    def prepare(self, node):
        node.feet = Feet(node.client, node.namespace + 'tread')

    def act(self, node, tick):
        meadow = node.client
        if 1 < tick < 90 and tick % 4 == 0:
            node.feet.send(step('robot', -4.0 + 0.04 * tick, 1.0))
        if tick == 30:
            Client(node.name).update_configuration({'tread_radius': 0.2, 'tread_recovery': 30.0})
        if tick in (35, 111):
            area = GrassCut(outline=[Point(0.01 * tick, -1, 0)], radius=0.8, height=0.05)
            self.assertTrue(meadow.cut(cut=area).success)
        if tick == 50:  # waits while the state is saved
            answer = meadow.tread(header=Header(stamp=time_of(START + 100)),
                                  points=points((0, 0), (3, 2)))
            self.assertTrue(answer.success)
        if tick == 40:
            disc = GrassColour(x=1.0, y=2.0, radius=3.0, colour=0.5, weight=2.0, velocity_x=0.25)
            self.assertTrue(meadow.set_colours(colours=[disc]).success)
        if tick == 110:
            self.assertTrue(meadow.tread(points=points((1, 0), (3, -2))).success)
        if tick == 112:
            centre = PointStamped(point=Point(1, 0, 0))
            self.assertTrue(meadow.clear(centre=centre, radius=0.5).success)

    def test_discs_of_colour_come_back_with_a_snapshot(self):
        node = self.start('coloured', 0)
        self.run_to(node, 0, 60)
        node.save('coloured')
        before = node.client.at(1.0, 2.0).colour
        self.colour(node)
        self.clock.run(1, node.client)
        after = node.client.at(1.0, 2.0).colour
        self.assertNotAlmostEqual(before, after, 2)
        node.load('coloured')
        self.assertAlmostEqual(node.client.at(1.0, 2.0).colour, before, 6)

    def colour(self, node, *colours):
        """Replaces the discs by discs of these colours around (1, 2), at the next tick."""
        discs = [GrassColour(x=1.0, y=2.0, radius=3.0, colour=c, weight=2.0) for c in colours]
        answer = node.client.set_colours(colours=discs)
        self.assertTrue(answer.success, answer.message)

    def test_discs_of_colour_that_wait_are_saved(self):
        node = self.start('coloured', 0)
        self.run_to(node, 0, 3)
        plain = node.client.at(1.0, 2.0).colour
        self.colour(node, 0.5)
        node.save('waiting')
        self.assertEqual(node.client.at(1.0, 2.0).colour, plain)
        self.colour(node)
        self.clock.run(1, node.client)
        node.load('waiting')
        self.assertAlmostEqual(node.client.at(1.0, 2.0).colour, plain, 6)
        self.clock.run(1, node.client)
        self.assertAlmostEqual(node.client.at(1.0, 2.0).colour, (plain + 2.0 * 0.5) / 3.0, 6)

    # The journal has them while they wait, and once they are in force.
    def test_discs_of_colour_survive_a_kill(self):
        node = self.start('coloured', 0, checkpoint_period=1000.0, checkpoint=True)
        self.run_to(node, 0, 3)
        plain = node.client.at(1.0, 2.0).colour
        self.colour(node, 0.5)
        for _ in range(2):
            self.restart(node)
            self.assertAlmostEqual(node.client.at(1.0, 2.0).colour, (plain + 2.0 * 0.5) / 3.0, 6)
        self.colour(node)
        self.clock.run(1, node.client)
        self.assertAlmostEqual(node.client.at(1.0, 2.0).colour, plain, 6)

    # A camera sees the discs.
    def test_the_hash_of_a_state_has_the_discs(self):
        hashes = []
        for colours in [], [0.5], [0.5], [0.6]:
            node = self.start('coloured_%d' % len(hashes), 0)
            self.run_to(node, 0, 3)
            self.colour(node, *colours)
            self.clock.run(1, node.client)
            hashes.append(node.state_hash())
            node.stop()
        self.assertEqual(hashes[1], hashes[2])
        self.assertEqual(len(set(hashes)), 3)

    def restart(self, node):
        """Kills a node, and runs a tick of the next process."""
        node.kill()
        node.client.wait_until_up(node.namespace + 'tread')
        self.clock.run(1, node.client)

    def tread_much(self, node):
        path = [Point(0.01 * i, 0.0, 0.0) for i in range(200)]
        return node.client.tread(points=path, law=TreadLaw(has_reach=True, reach=10.0))

    # The work that waits is bounded in the next process as it was, and none of it is lost.
    def test_work_that_waits_survives_a_kill(self):
        hashes, refused = [], []
        for name, kills in ('plain', False), ('killed', True):
            node = self.start(name, 0, checkpoint_period=1000.0, checkpoint=True)
            self.run_to(node, 0, 2)
            later = Header(stamp=time_of(START + 8))
            names = ['wide_%03d' % i for i in range(150)]
            for wide in names:
                node.feet.send(wide_stroke(wide, (-9.0, 0.0), (9.0, 0.0), header=later))
            refused.append(int(node.client.diagnostics()['Inputs refused']))
            self.assertTrue(0 < refused[0] < len(names), refused)
            if kills:
                self.restart(node)
                answer = self.tread_much(node)
                self.assertIn('nodes of treads and cuts that wait = ', answer.message)
                self.assertFalse(answer.success)
            else:
                self.clock.run(1, node.client)
            self.run_to(node, 3, 8)
            hashes.append(node.state_hash())
            answer = self.tread_much(node)  # nothing waits
            self.assertTrue(answer.success, answer.message)
            wait_for(lambda: node.client.trodden('wide_') == names[:len(names) - refused[0]],
                     'the events of the strokes')
            node.stop()
        self.assertEqual(*refused)
        self.assertEqual(*hashes)

    def test_displays_get_a_complete_state_after_a_load(self):
        node = self.start('shown', 0)
        self.run_to(node, 0, 40)
        node.save('early')
        self.run_to(node, 40, 43)
        self.assertFalse(node.client.state.messages[-1].key_frame)
        node.load('early')
        self.clock.run(1, node.client)
        self.assertTrue(node.client.state.messages[-1].key_frame)


if __name__ == '__main__':
    rospy.init_node('grass_snapshot_test')
    rostest.rosrun('vegetation_sim', 'grass_snapshot', GrassSnapshot)
