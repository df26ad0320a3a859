#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Branches are held by services and tf frames (S1-25, S1-33, S1-37, N3)."""
import math
import signal
import subprocess
import unittest

import roslib.packages
import rospy
import rostest
from geometry_msgs.msg import Vector3, Vector3Stamped
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ForestEvent

from forest_rig import RATE, TickClock, time_of
from grab_rig import (LIMB, OTHER_LIMB, STIFFNESS, TREE, Hands, minus, plus, size, stamped, vector)
from waiting import DEADLINE, wait_for
from watched_node import Log

TF_BUDGET = 12
TURN = (0.0, 0.0, math.sin(0.5), math.cos(0.5))  # rotation by 1 rad about z


def into_turned(v):
    """Returns a world vector in the axes of a frame that is rotated by TURN."""
    c, s = math.cos(1.0), math.sin(1.0)
    return (c * v[0] + s * v[1], -s * v[0] + c * v[1], v[2])


class ForestGrab(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands = Hands(cls.clock)
        cls.clock.begin(cls.hands)

    def tearDown(self):
        self.hands.let_all_go()

    def distance(self, branch, along, target):
        return size(minus(self.hands.point(branch, along), target))

    # The spring force on the gripper points from the target to the branch.
    def expect_spring(self, wrench, held, target, into=lambda v: v):
        expected = into([STIFFNESS * x for x in minus(held, target)])
        force = vector(wrench.wrench.force)
        self.assertGreater(size(force), 5.0)
        # The damper adds a force while wind moves the branch.
        self.assertLess(size(minus(force, expected)), 0.05 * size(force) + 1.0, (force, expected))

    def test_by_id_it_follows_and_is_forgotten_after(self):
        calm = self.hands.point(LIMB, 0.3)
        answer, target = self.hands.take_at((0.15, 0.0, 0.05))
        self.assertEqual((answer.tree, answer.branch, answer.along), (TREE, LIMB, 0.3))
        self.assertLess(size(minus(vector(answer.point), calm)), 1e-9)
        self.hands.run(3 * RATE)
        tree = self.hands.tree(TREE)
        self.assertIn(LIMB, tree.physical)
        self.assertLess(len(tree.physical), len(tree.parents), 'more than what is influenced')
        self.assertEqual([g.id for g in tree.grabs], [answer.id])
        held = self.hands.point(LIMB, 0.3)
        self.assertLess(size(minus(held, target)), 0.5 * 0.158)
        self.expect_spring(self.hands.wrench(), held, target)
        self.assertEqual(self.hands.wrench().header.frame_id, 'map')
        self.assertTrue(self.hands.release(id=answer.id).success)
        self.hands.run(1)
        self.assertIn(LIMB, self.hands.physical())
        self.hands.let_all_go()
        figures = self.hands.diagnostics()
        for key in ('Grabs', 'Physical trees', 'Physical branches', 'Physics memory [B]'):
            self.assertEqual(figures[key], 0, key)

    def test_by_point_it_takes_the_nearest_branch(self):
        beside = plus(self.hands.point(OTHER_LIMB, 0.2), (0.0, 0.0, 0.001))
        answer = self.hands.take(nearest=True, point=stamped(beside), target=stamped(beside))
        self.assertEqual((answer.tree, answer.branch), (TREE, OTHER_LIMB))
        self.assertAlmostEqual(answer.along, 0.2, delta=0.002)

    def test_by_frame_it_follows_the_gripper_and_sends_the_wrench_in_its_frame(self):
        place = self.hands.point(LIMB, 0.3)
        self.hands.wait_for_frame('hand', place)
        self.hands.show_frame('hand', place, TURN)
        self.hands.take(branch=LIMB, along=0.3, frame='hand', lease=0.5)
        for i in range(3 * RATE):
            share = min(1.0, i / RATE)
            place_now = plus(place, (0.15 * share, 0.0, 0.05 * share))
            self.hands.show_frame('hand', place_now, TURN, time_of(self.clock.tick + 1))
            self.hands.run(1)
        held, wrench = self.hands.point(LIMB, 0.3), self.hands.wrench()
        self.assertEqual(wrench.header.frame_id, 'hand')
        self.expect_spring(wrench, held, place_now, into_turned)
        # The branch is held at the origin of the frame, so the lever arm about it is small.
        self.assertLess(size(vector(wrench.wrench.torque)),
                        size(minus(held, place_now)) * size(vector(wrench.wrench.force)) + 0.01)
        events = [e for e in self.hands.events.messages if e.kind == ForestEvent.MOVE]
        self.assertGreater(len(events), 2 * RATE)

    # A renewal does not contain a target: the newest position of the gripper remains the target.
    def test_a_renewal_leaves_the_target_alone(self):
        place = self.hands.point(LIMB, 0.3)
        self.hands.wait_for_frame('hand', place)
        answer = self.hands.take(branch=LIMB, along=0.3, frame='hand')
        first = len(self.hands.events.messages)
        renewals = lambda all: sum(e.kind == ForestEvent.RENEW for e in all[first:])
        for i in range(RATE):
            place_now = plus(place, (0.1 * i / RATE, 0.0, 0.0))
            self.hands.show_frame('hand', place_now, stamp=time_of(self.clock.tick + 1))
            reply = self.hands.move_grab(id=answer.id, renew_only=True)
            self.assertEqual(reply.message, 'lease renewed')
            self.hands.run(1)
        events = self.hands.events.wait(lambda all: renewals(all) == RATE and all[first:],
                                        'all renewals')
        # Each tick has only the move of the frame.
        moves = [e.header.stamp for e in events if e.kind == ForestEvent.MOVE]
        self.assertGreater(len(moves), RATE // 2)
        self.assertEqual(len(moves), len(set(moves)))
        self.expect_spring(self.hands.wrench(), self.hands.point(LIMB, 0.3), place_now)

    def test_a_renewal_undoes_no_move_of_its_stamp(self):
        answer, target = self.hands.take_at((0.0, 0.0, 0.0))
        self.hands.run(1)
        later = time_of(self.clock.tick + 5)
        moved = plus(target, (0.1, 0.0, 0.0))
        self.assertTrue(self.hands.move_grab(id=answer.id, target=stamped(moved), stamp=later).success)
        self.assertTrue(self.hands.move_grab(id=answer.id, renew_only=True, stamp=later).success)
        self.assertTrue(self.hands.move_grab(id=answer.id, renew_only=True).success)
        self.hands.run(2 * RATE)
        self.assertLess(size(minus(vector(self.hands.tree(TREE).grabs[0].target), moved)), 1e-9)
        self.assertLess(self.distance(LIMB, 0.3, moved), 0.05)

    def test_two_grabs_on_one_tree(self):
        first, target = self.hands.take_at((0.1, 0.0, 0.0))
        second, other = self.hands.take_at((-0.1, 0.0, 0.0), OTHER_LIMB, 0.2)
        self.assertNotEqual(first.id, second.id)
        self.hands.run(3 * RATE)
        self.assertLess(self.distance(LIMB, 0.3, target), 0.07)
        self.assertLess(self.distance(OTHER_LIMB, 0.2, other), 0.07)
        stamp = time_of(self.clock.tick)
        self.hands.wrenches.wait(lambda all: sum(m.header.stamp == stamp for m in all) == 2,
                                 'both wrenches')
        self.assertEqual([g.id for g in self.hands.tree(TREE).grabs], [first.id, second.id])
        self.hands.release(id=first.id)
        self.hands.run(RATE)
        self.assertEqual([g.id for g in self.hands.tree(TREE).grabs], [second.id])
        self.assertLess(self.distance(OTHER_LIMB, 0.2, other), 0.07)

    def test_a_move_moves_and_renews(self):
        answer, target = self.hands.take_at((0.0, 0.0, 0.0), lease=1.0)
        for i in range(5):
            self.hands.run(RATE // 2)
            moved = plus(target, (0.02 * i, 0.0, 0.0))
            if i < 3:
                reply = self.hands.move_grab(id=answer.id, target=stamped(moved))
                last = moved
            else:
                reply = self.hands.move_grab(id=answer.id, renew_only=True)
            self.assertTrue(reply.success, reply.message)
            self.assertLess(size(minus(vector(reply.point), self.hands.point(LIMB, 0.3))), 1e-9)
        expected = [STIFFNESS * x for x in minus(vector(reply.point), last)]
        self.assertGreater(size(expected), 5.0)
        self.assertLess(size(minus(vector(reply.force), expected)), 0.05 * size(expected) + 1.0)
        self.hands.run(RATE)
        self.assertLess(self.distance(LIMB, 0.3, last), 0.03)
        self.assertEqual(len(self.hands.tree(TREE).grabs), 1)
        self.hands.run(RATE)
        self.assertEqual(self.hands.tree(TREE).grabs, [])
        self.assertIn('id = %d has ended: its lease expired; nothing is held' % answer.id,
                      self.hands.move_grab(id=answer.id).message)

    def test_a_killed_holder_loses_its_grab(self):
        before = self.hands.diagnostics()['Grabs ended by their lease']
        program = roslib.packages.find_node('vegetation_sim', 'scripted_gripper.py')[0]
        holder = subprocess.Popen([program, '__name:=gripper'])
        frames = Log('/tf', TFMessage)

        def is_moved():
            return any(frame.child_frame_id == 'gripper' and
                       frame.header.stamp >= time_of(self.clock.tick)
                       for message in frames.messages[-20:] for frame in message.transforms)
        try:
            self.clock.run_until(lambda: self.hands.tree(TREE).grabs, 'a grab', self.hands)
            for _ in range(RATE):
                self.hands.run(1)
                wait_for(is_moved, 'the frame of the gripper')
            self.assertEqual(len(self.hands.tree(TREE).grabs), 1)
        finally:
            holder.send_signal(signal.SIGKILL)
            holder.wait(DEADLINE)
            frames.close()
        self.hands.run(RATE // 2)
        self.assertEqual(len(self.hands.tree(TREE).grabs), 1)
        self.hands.run(RATE)
        self.assertEqual(self.hands.tree(TREE).grabs, [])
        self.assertEqual(self.hands.diagnostics()['Grabs ended by their lease'], before + 1)

    def test_the_force_is_limited(self):
        self.hands.take_at((2.0, 0.0, 0.0), force_limit=20.0)
        self.hands.run(2 * RATE)
        self.assertAlmostEqual(size(vector(self.hands.wrench().wrench.force)), 20.0, delta=0.02)
        self.assertGreater(self.hands.diagnostics()['Forces at their limit'], 0)

    def test_a_grab_during_the_blend_takes_over_without_a_jump(self):
        answer, target = self.hands.take_at((0.15, 0.0, 0.0))
        self.hands.run(2 * RATE)
        self.hands.release(id=answer.id)

        def blends():
            trees = [t for t in self.hands.state.messages[-1].trees if t.tree == TREE]
            return any(b.branch == LIMB and b.blend.to_sec() > 0 for t in trees for b in t.promoted)
        self.clock.run_until(blends, 'the blend', self.hands)
        self.hands.run(RATE // 2)
        self.assertTrue(blends())
        before = self.hands.point(LIMB, 0.3)
        self.hands.take(branch=LIMB, along=0.3, target=stamped(before))
        for _ in range(RATE):
            self.hands.run(1)
            after = self.hands.point(LIMB, 0.3)
            # 0.6 m/s is more than this wind moves the branch.
            self.assertLess(size(minus(after, before)), 0.02)
            before = after
        self.assertFalse(blends())
        self.assertLess(self.distance(LIMB, 0.3, before), 0.02)

    def test_a_force_bends_for_its_time(self):
        calm = self.hands.point(LIMB, 0.3)
        force = Vector3Stamped(vector=Vector3(0.0, 0.0, -300.0))
        answer = self.hands.apply_force(tree=TREE, branch=LIMB, along=0.3, force=force, duration=1.0)
        self.assertTrue(answer.success, answer.message)
        self.hands.run(RATE)
        self.assertIn(LIMB, self.hands.physical())
        self.assertLess(self.hands.point(LIMB, 0.3)[2], calm[2] - 0.01)
        self.clock.run_until(lambda: not self.hands.physical(), 'the end', self.hands)

    # S1-W3: the calibration run makes all branches of a tree physical, also without a force.
    def test_a_whole_tree_is_physical_for_its_time(self):
        answer = self.hands.apply_force(tree=TREE, branch=0, duration=0.5, whole_tree=True)
        self.assertTrue(answer.success, answer.message)
        self.hands.run(2)
        tree = self.hands.tree(TREE)
        self.assertEqual(list(tree.physical), list(range(len(tree.parents))))
        self.clock.run_until(lambda: not self.hands.physical(), 'the end', self.hands)

    def test_a_request_may_be_ahead(self):
        start = time_of(self.clock.tick + RATE)
        answer, _ = self.hands.take_at((0.1, 0.0, 0.0), stamp=start)
        self.hands.run(RATE - 1)
        self.assertEqual(self.hands.physical(), [])
        self.hands.run(1)
        self.assertIn(LIMB, self.hands.physical())
        event = self.hands.events.wait(
            lambda all: next((e for e in all if e.kind == ForestEvent.GRAB and
                              e.grab.id == answer.id), None), 'the grab')
        self.assertEqual(event.header.stamp, start)

    def test_a_grab_that_waits_is_moved_from_its_time_on(self):
        start = time_of(self.clock.tick + 10)
        answer, target = self.hands.take_at((0.0, 0.0, 0.0), stamp=start)
        moved = stamped(plus(target, (0.1, 0.0, 0.0)))
        for request in (dict(target=moved), dict(renew_only=True),
                        dict(target=moved, stamp=start - rospy.Duration.from_sec(1.0 / RATE))):
            reply = self.hands.move_grab(id=answer.id, **request)
            self.assertFalse(reply.success)
            self.assertIn('id = %d takes hold at %f s; allowed is a stamp from then on' %
                          (answer.id, start.to_sec()), reply.message)
        self.assertTrue(self.hands.move_grab(id=answer.id, target=moved, stamp=start).success)
        self.hands.run(12)
        grabs = self.hands.tree(TREE).grabs
        self.assertEqual([g.target for g in grabs], [moved.point])

    def test_a_grab_that_is_released_before_its_time_never_begins(self):
        for early in (0, 1, 9):
            start = time_of(self.clock.tick + 10)
            answer, _ = self.hands.take_at((0.1, 0.0, 0.0), stamp=start)
            stamp = time_of(self.clock.tick + 10 - early) if early < 9 else rospy.Time()
            self.assertTrue(self.hands.release(id=answer.id, stamp=stamp).success)
            self.hands.run(15)
            self.assertEqual(self.hands.physical(), [])
            self.assertEqual([e for e in self.hands.events.messages
                              if e.kind == ForestEvent.GRAB and e.grab.id == answer.id], [])

    def test_a_grab_ahead_begins_where_its_frame_is_by_then(self):
        place = self.hands.point(LIMB, 0.3)
        self.hands.wait_for_frame('hand', place)
        grabs = [self.hands.take(branch=LIMB, along=0.3, frame='hand', keep_offset=keep,
                                 stamp=time_of(self.clock.tick + 10)).id for keep in (False, True)]
        place = plus(place, (0.2, 0.0, 0.0))
        for _ in range(9):
            self.hands.show_frame('hand', place, stamp=time_of(self.clock.tick))
            self.hands.settle()
            self.hands.run(1)
        self.assertEqual(self.hands.tree(TREE).grabs, [])
        held = self.hands.point(LIMB, 0.3)
        self.hands.run(1)
        plain, slack = self.hands.tree(TREE).grabs
        self.assertEqual([plain.id, slack.id], grabs)
        self.assertLess(size(minus(vector(plain.target), place)), 1e-9)
        self.assertLess(size(minus(vector(slack.target), held)), 1e-9)

    def test_time_that_jumps_ends_every_grab(self):
        self.hands.take_at((0.15, 0.0, 0.0))
        self.hands.run(RATE)
        self.clock.show(self.clock.tick - 10 * RATE)
        self.hands.state.wait_for_stamp(time_of(self.clock.tick))
        tree = self.hands.tree(TREE)
        self.assertEqual((list(tree.physical), tree.grabs), ([], []))
        _, target = self.hands.take_at((0.1, 0.0, 0.0))
        self.hands.run(2 * RATE)
        self.assertLess(self.distance(LIMB, 0.3, target), 0.05)
        self.clock.show(self.clock.tick + 1000 * RATE)  # The clock jumps beyond the lease.
        self.hands.state.wait_for_stamp(time_of(self.clock.tick))
        self.hands.run(RATE)
        tree = self.hands.tree(TREE)
        self.assertEqual(tree.grabs, [])
        for pose in tree.transforms.poses:
            self.assertTrue(math.isfinite(sum(vector(pose.position))))

    def test_frames_of_physical_branches_keep_to_the_budget(self):
        frames = Log('/tf', TFMessage)
        self.hands.take_at((0.2, 0.0, 0.0))
        self.hands.run(RATE)
        self.assertGreater(len(self.hands.physical()), TF_BUDGET)

        def rounds(messages):
            sent = [[t.child_frame_id for t in m.transforms] for m in messages]
            return [r for r in sent if r and r[0].startswith('tree_')]
        newest = frames.wait(lambda all: rounds(all) and rounds(all)[-1], 'frames of branches')
        frames.close()
        self.assertIn('tree_%d/branch_%d' % (TREE, LIMB), newest)
        self.assertEqual(max(len(r) for r in rounds(frames.messages)), TF_BUDGET)


if __name__ == '__main__':
    rospy.init_node('forest_grab_test')
    rostest.rosrun('vegetation_sim', 'forest_grab', ForestGrab)
