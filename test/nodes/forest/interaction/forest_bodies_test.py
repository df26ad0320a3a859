#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A body attached to a tf frame pushes a limb aside, gets its wrench and is removed when tf is
silent."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Vector3, Vector3Stamped
from vegetation_sim.msg import ForestEvent
from vegetation_sim.srv import ApplyForce

from forest_rig import RATE, TickClock, time_of
from grab_rig import LIMB, TREE, Hands, along_z, minus, plus, size, vector
from waiting import wait_for

SPEED = 0.3  # [m/s]
RADIUS = 0.06
ALONG = 0.3  # [m]
MOST_AHEAD = 5000  # limit of the requests that wait for later stamps
TRUNK = 0
OVERLAP, OVERLAP_AT = 'Deepest overlap with a body [m]', 'Deepest overlap, where'


def times(factor, v):
    return tuple(factor * x for x in v)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Bodies(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(100 * RATE)
        cls.hands = Hands(cls.clock)
        cls.clock.begin(cls.hands)

    def sideways(self):
        """Returns the horizontal direction across the limb."""
        pose = self.hands.tree(TREE).transforms.poses[LIMB]
        axis = minus(along_z(pose, 1.0), vector(pose.position))
        across = (-axis[1], axis[0], 0.0)
        return times(1.0 / size(across), across)

    def kinds(self):
        return [event.kind for event in self.hands.events.messages]

    def show_hand(self, place):
        """Returns when the node has received the frame; the next tick publishes it as an event."""
        self.hands.show_frame('hand', place)
        self.hands.settle()

    def test_limb_is_pushed_aside_and_the_hand_gets_the_wrench(self):
        hands, side = self.hands, self.sideways()
        start = plus(hands.point(LIMB, ALONG), times(-0.25, side))

        def reported():
            self.show_hand(start)
            hands.run(1)
            return ForestEvent.BODY in self.kinds()
        wait_for(reported, 'an event of the body')

        ticks, place = 0, start
        while ticks < 1.2 * RATE:
            place = plus(start, times(SPEED * ticks / RATE, side))
            self.show_hand(place)
            hands.run(1)
            ticks += 1
        limb = hands.point(LIMB, ALONG)
        wrenches = [w for w in hands.wrenches.messages if w.header.frame_id == 'hand']
        # The limb is in front of the hand, not in it or behind it. The margin is 1 cm because tf
        # may be a tick late.
        self.assertGreater(dot(minus(limb, place), side), RADIUS - 0.01)
        self.assertIn(LIMB, hands.physical())
        self.assertGreater(len(wrenches), 10)
        force = vector(wrenches[-1].wrench.force)
        self.assertLess(dot(force, side), 0.0)
        self.assertTrue(all(math.isfinite(x) for x in force))

        # When tf is silent, the body is removed and soon no branch is physical.
        self.clock.run_until(lambda: ForestEvent.REMOVE_BODY in self.kinds(), 'the end of the body',
                             hands)
        self.clock.run_until(lambda: not hands.physical(), 'a calm tree', hands)
        count = len(hands.wrenches.messages)
        hands.run(RATE)
        self.assertEqual(len(hands.wrenches.messages), count)

    # A body penetrates wood that cannot yield. The diagnostics report the depth, the body and the
    # place.
    def test_overlap_is_reported(self):
        hands = self.hands
        tree = hands.tree(TREE)
        radius = tree.radii[TRUNK]
        inside = 0.03  # [m]
        at = plus(hands.point(TRUNK, 0.3), (radius + RADIUS - inside, 0.0, 0.0))

        def reported():
            self.show_hand(at)
            hands.run(1)
            return OVERLAP_AT in hands.diagnostics()
        wait_for(reported, 'an overlap')
        figures = hands.diagnostics()
        # At the height of the hand the trunk leans, tapers and yields by less than 1 cm each.
        self.assertAlmostEqual(figures[OVERLAP], inside, delta=0.01)
        self.assertEqual(figures[OVERLAP_AT], 'palm in tree_%d/branch_%d' % (TREE, TRUNK))
        self.assertIn(figures[OVERLAP_AT] + ': wood is overrun', hands.status().message)
        self.clock.run_until(lambda: not hands.physical(), 'a calm tree', hands)
        wait_for(lambda: hands.diagnostics()[OVERLAP] == 0.0, 'a report without an overlap')
        self.assertNotIn(OVERLAP_AT, hands.diagnostics())
        self.assertNotIn('overrun', hands.status().message)

    def test_requests_for_later_that_flood_stop_neither_body_nor_node(self):
        start = self.hands.point(LIMB, ALONG)
        place = plus(start, (0.0, 0.0, 5.0))
        apply_force = rospy.ServiceProxy(self.hands.name + '/apply_force', ApplyForce,
                                         persistent=True)
        push = Vector3Stamped(vector=Vector3(1.0, 0.0, 0.0))

        def ask(ahead=50 * RATE):
            stamp = time_of(self.clock.tick + ahead) if ahead else rospy.Time()
            return apply_force(tree=TREE, branch=LIMB, along=0.1, force=push, duration=0.1,
                               stamp=stamp)
        for _ in range(MOST_AHEAD):
            self.assertTrue(ask().success)
        self.assertIn('too many inputs wait already', ask().message)
        self.assertTrue(ask(0).success, 'a request for the next tick')
        bodies = self.kinds().count(ForestEvent.BODY)

        def reported():
            self.show_hand(place)
            self.hands.run(1)
            return self.kinds().count(ForestEvent.BODY) > bodies
        wait_for(reported, 'the body in the flood')
        self.clock.show(self.clock.tick - 10 * RATE)
        self.hands.state.wait_for_stamp(time_of(self.clock.tick))
        self.assertTrue(ask().success)


if __name__ == '__main__':
    rospy.init_node('forest_bodies_test')
    rostest.rosrun('vegetation_sim', 'forest_bodies', Bodies)
