#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Bodies and walkers push the plants of canopy_animator: states, samples, canopy/contacts, and a
replay with the same hashes."""
import unittest

import rospy
import rostest
from vegetation_sim.msg import AgentState, AgentStates, CanopyEvent, PlantContacts
from vegetation_sim.srv import LoadSnapshot, SaveSnapshot

from canopy_rig import ReplayedLeaves
from crowd_rig import Cart
from forest_rig import RATE, time_of
from replaying import compare_replay
from watched_node import Log, publisher, wait_for_readers

BEGIN = 1000 * RATE
SPEED = 1.5  # [m/s]
SIDE = (0.0, 0.0, 1.0)  # in the middle of the nearer shrub


class CanopyContacts(ReplayedLeaves, unittest.TestCase):
    def setUp(self):
        self.contacts = Log('/canopy/contacts', PlantContacts)
        self.begin(BEGIN)
        self.cart = Cart(self.leaves)

    def drive(self, start, ticks):
        """Drives the cart along x, one way per tick."""
        for i in range(ticks):
            self.cart.put(start + SPEED * i / RATE, 0.1, time_of(self.clock.tick + 1))
            self.run_ticks(1)
        return start + SPEED * ticks / RATE

    def bent(self):
        """Returns the cells that lean at the last tick."""
        last = self.leaves.state.messages[-1]
        return list(zip(last.bent_plants, last.bent_cells, last.lean_x, last.lean_y))

    def touched(self, first):
        self.contacts.wait_for_stamp(time_of(self.clock.tick))
        return [m for m in self.contacts.messages[first:] if m.contacts]

    def test_plants_answer_bodies_and_walkers(self):
        self.expect_nothing_without_bodies()
        self.expect_force_and_lean()
        self.expect_plants_to_stand_up()
        self.expect_walkers_to_push()
        self.expect_equal_replay()

    def expect_nothing_without_bodies(self):
        self.assertEqual(self.bent(), [])
        self.assertEqual(self.contacts.messages, [])

    def expect_force_and_lean(self):
        before = self.leaves.at(*SIDE).displacement.x
        self.drive(-2.5, 50)
        touched = self.touched(0)
        self.assertGreater(len(touched), 10)
        work = 0.0
        for message in touched:
            self.assertEqual(message.header.frame_id, 'map')
            for contact in message.contacts:
                self.assertEqual((contact.body, contact.frame, contact.plant), ('hull', 'cart', 0))
                self.assertGreater(contact.overlap, 0.0)
                force, framed = contact.force, contact.wrench.force
                # The axes of the cart are those of the world.
                for axis in 'xyz':
                    self.assertAlmostEqual(getattr(force, axis), getattr(framed, axis), 6)
                work -= force.x * SPEED / RATE
        self.assertGreater(work, 1.0)
        # The wrench is about the origin of the frame: the point is 0.5 m above it.
        contact = touched[-1].contacts[0]
        self.assertAlmostEqual(contact.wrench.torque.y, contact.wrench.force.x * contact.point.z,
                               delta=0.35 * abs(contact.wrench.force.x) + 0.8 * abs(contact.wrench.force.z))
        self.assertEqual({plant for plant, *_ in self.bent()}, {0})
        self.assertGreater(self.leaves.at(*SIDE).displacement.x - before, 0.1)
        values = self.leaves.diagnostics()
        self.assertEqual((values['Bodies'], values['Plants that bodies have pushed']), (1, 1))

    def expect_plants_to_stand_up(self):
        # Without a transform for half a second the body is gone.
        self.run_ticks(RATE)
        self.assertIn(CanopyEvent.REMOVE_BODY, [e.kind for e in self.leaves.events.messages])
        self.assertEqual(self.contacts.messages[-1].contacts, [])
        self.run_ticks(4 * RATE)
        self.assertEqual(self.bent(), [])

    def expect_walkers_to_push(self):
        agents = publisher('/agents', AgentStates)
        wait_for_readers('/agents', self.leaves.process)
        first = len(self.contacts.messages)
        for i in range(20):
            message = AgentStates()
            message.header.frame_id, message.header.stamp = 'map', time_of(self.clock.tick + 1)
            for walker, x in ((7, 0.04 * i - 0.3), (9, 60.0)):
                agent = AgentState(id=walker, radius=0.25, height=1.8)
                agent.pose.position.x, agent.pose.orientation.w = x, 1.0
                agent.velocity.x = 0.04 * RATE
                message.agents.append(agent)
            agents.publish(message)
            self.leaves.settle()
            self.run_ticks(1)
        touched = self.touched(first)
        self.assertGreater(len(touched), 10)
        self.assertEqual({c.body for m in touched for c in m.contacts}, {'walker_7'})
        mean = sum(c.force.x for m in touched for c in m.contacts) / len(touched)
        self.assertLess(mean, -1.0)
        self.assertGreater(len(self.bent()), 3)
        moved = [e.body.id for e in self.leaves.events.messages if e.kind == CanopyEvent.BODY]
        self.assertNotIn('walker_9', moved)  # It is far from all plants.
        self.expect_snapshot_to_hold()
        self.run_ticks(RATE)
        self.assertEqual(self.leaves.diagnostics()['Bodies'], 0)
        agents.unregister()

    def expect_snapshot_to_hold(self):
        """A loaded state has the plants as bodies had pushed them."""
        saved = rospy.ServiceProxy('/canopy_animator/save_snapshot', SaveSnapshot)(name='pushed')
        self.assertTrue(saved.success, saved.message)
        self.run_ticks(1)
        after = self.bent()
        self.run_ticks(4 * RATE)
        self.assertEqual(self.bent(), [])
        load = rospy.ServiceProxy('/canopy_animator/load_snapshot', LoadSnapshot)
        loaded = load(name='pushed')
        self.assertTrue(loaded.success, loaded.message)
        self.again.settle()
        self.run_ticks(1)
        # The walker is gone, so that the plants have begun to swing back.
        self.assertEqual([cell[:2] for cell in self.bent()], [cell[:2] for cell in after])

    def expect_equal_replay(self):
        states, different = compare_replay(
            self, lambda: (self.leaves.hashes(), self.again.hashes()))
        self.assertGreater(states, 4)
        self.assertEqual(different, [])
        leans = [{m.header.stamp: (m.bent_plants, m.bent_cells, m.lean_x, m.lean_y)
                  for m in node.state.messages} for node in (self.leaves, self.again)]
        both = sorted(set(leans[0]) & set(leans[1]))
        self.assertGreater(sum(bool(leans[0][s][0]) for s in both), 60)
        self.assertEqual([s for s in both if leans[0][s] != leans[1][s]], [])


if __name__ == '__main__':
    rospy.init_node('canopy_contacts_test')
    rostest.rosrun('vegetation_sim', 'canopy_contacts', CanopyContacts)
