#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""forest/grabs names the grabs in force and the reason why each has ended, and forest/forces names
the grab and the place of each force."""
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from std_srvs.srv import Trigger
from vegetation_sim.msg import ContactForces, GrabStatus, GrabStatuses

from forest_rig import RATE, TickClock, time_of
from grab_rig import LIMB, OTHER_LIMB, TREE, Hands, minus, plus, size, stamped, vector
from waiting import wait_for
from watched_node import Log


class ForestGrabStatus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands = Hands(cls.clock)
        cls.grabs = Log('/forest/grabs', GrabStatuses)
        cls.forces = Log('/forest/forces', ContactForces)
        cls.clock.begin(cls.hands)
        for log in (cls.grabs, cls.forces):
            wait_for(log.connected, log.topic)
        cls.server = Client('/forest_animator', timeout=30)

    @classmethod
    def tearDownClass(cls):
        cls.server.close()

    def tearDown(self):
        self.hands.let_all_go()

    def held(self):
        """Returns the grabs in force by id."""
        return {g.grab.id: g for g in self.grabs.messages[-1].held}

    def expect_end(self, grab, status):
        """Runs until the grab has ended. Returns its record."""
        self.clock.run_until(
            lambda: any(g.grab.id == grab for g in self.grabs.messages[-1].ended), 'the end',
            self.hands)
        found = [g for g in self.grabs.messages[-1].ended if g.grab.id == grab]
        self.assertEqual([g.status for g in found], [status])
        self.assertNotIn(grab, self.held())
        return found[0]

    def take(self, **request):
        """Grabs the limb where it is and runs until the grab is reported. Returns its id."""
        answer, _ = self.hands.take_at((0.0, 0.0, 0.0), **request)
        self.hands.run(1)
        self.grabs.wait(lambda all: answer.id in self.held(), 'the grab')
        return answer.id

    def test_a_grab_in_force_is_reported_with_its_place_and_times(self):
        begin = time_of(self.clock.tick + 1)
        grab = self.take(lease=7.0)
        found = self.held()[grab]
        self.assertEqual((found.status, found.grab.tree, found.grab.branch, found.grab.along),
                         (GrabStatus.HELD, TREE, LIMB, 0.3))
        self.assertEqual((found.since, found.until), (begin, begin + rospy.Duration(7)))
        self.assertTrue(self.hands.move_grab(id=grab, renew_only=True).success)
        self.hands.run(RATE + 1)
        self.grabs.wait(lambda all: self.held()[grab].until > found.until, 'the renewal')
        self.assertEqual(self.held()[grab].since, begin)
        late = Log('/forest/grabs', GrabStatuses)
        newest = late.wait(lambda all: all and all[-1], 'the grabs for a late subscriber')
        late.close()
        self.assertEqual([g.grab.id for g in newest.held], [grab])

    def test_a_release_is_named(self):
        grab = self.take()
        next_tick = time_of(self.clock.tick + 1)
        self.assertTrue(self.hands.release(id=grab).success)
        end = self.expect_end(grab, GrabStatus.RELEASED)
        self.assertEqual(end.until, next_tick)

    def test_a_lost_lease_is_named(self):
        grab = self.take(lease=0.5)
        begin = self.held()[grab].since
        end = self.expect_end(grab, GrabStatus.LEASE_EXPIRED)
        self.assertGreater(end.until - begin, rospy.Duration.from_sec(0.5))

    def test_trees_that_change_are_named(self):
        grab = self.take()
        for scale in (0.9, 1.0):
            self.server.update_configuration({'size': scale})
            self.hands.run(2)
        self.expect_end(grab, GrabStatus.TREES_CHANGED)

    def test_a_reset_is_named(self):
        grab = self.take()
        self.assertTrue(rospy.ServiceProxy('/forest_animator/reset', Trigger)().success)
        self.expect_end(grab, GrabStatus.RESET)

    def test_a_jump_back_is_named_for_grabs_in_force_and_for_those_that_wait(self):
        grab = self.take()
        waits, _ = self.hands.take_at((0.0, 0.0, 0.0), stamp=time_of(self.clock.tick + RATE))
        self.clock.show(self.clock.tick - 10 * RATE)
        self.hands.state.wait_for_stamp(time_of(self.clock.tick))
        self.expect_end(grab, GrabStatus.RESET)
        self.expect_end(waits.id, GrabStatus.RESET)

    def test_a_grab_that_is_released_before_it_begins_is_named(self):
        answer, _ = self.hands.take_at((0.0, 0.0, 0.0), stamp=time_of(self.clock.tick + RATE))
        self.assertTrue(self.hands.release(id=answer.id).success)
        end = self.expect_end(answer.id, GrabStatus.RELEASED)
        self.assertEqual(end.since, rospy.Time())

    # The frame is near at the request and far away at the tick of the grab.
    def test_a_grab_that_is_refused_at_its_tick_is_named(self):
        place = self.hands.point(LIMB, 0.3)
        self.hands.wait_for_frame('hand', place)
        answer = self.hands.take(branch=LIMB, along=0.3, frame='hand',
                                 stamp=time_of(self.clock.tick + 5))
        for _ in range(6):
            self.hands.show_frame('hand', plus(place, (500.0, 0.0, 0.0)),
                                  stamp=time_of(self.clock.tick))
            self.hands.settle()
            self.hands.run(1)
        self.expect_end(answer.id, GrabStatus.REFUSED)

    def test_forces_name_grab_and_place(self):
        _, target = self.hands.take_at((0.1, 0.0, 0.0))
        answer, _ = self.hands.take_at((0.0, 0.1, 0.0), branch=OTHER_LIMB)
        self.hands.run(RATE)
        stamp = time_of(self.clock.tick)
        forces = self.forces.wait_for_stamp(stamp).forces
        places = {f.grab: (f.tree, f.branch, f.along, f.body, f.frame) for f in forces}
        self.assertEqual(places, {answer.id - 1: (TREE, LIMB, 0.3, '', ''),
                                  answer.id: (TREE, OTHER_LIMB, 0.3, '', '')})
        first = next(f for f in forces if f.branch == LIMB)
        self.assertLess(size(minus(vector(first.point), self.hands.point(LIMB, 0.3))), 1e-6)
        # The force on the holder points from the target to the branch, in world axes without frame.
        self.assertEqual(vector(first.force), vector(first.wrench.force))
        self.assertGreater(size(vector(first.force)), 5.0)
        self.assertLess(first.force.x, 0.0)
        moved = self.hands.move_grab(id=first.grab, target=stamped(target))
        self.assertEqual(vector(moved.force), vector(first.force))

    def test_a_tick_without_forces_has_an_empty_message(self):
        self.hands.run(1)
        message = self.forces.wait_for_stamp(time_of(self.clock.tick))
        self.assertEqual((message.header.frame_id, message.forces), ('map', []))


if __name__ == '__main__':
    rospy.init_node('forest_grab_status_test')
    rostest.rosrun('vegetation_sim', 'forest_grab_status', ForestGrabStatus)
