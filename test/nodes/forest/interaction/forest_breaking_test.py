#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A branch breaks where the bending stress passes the strength of its wood, another is cut; both
are reported, and a replay of the inputs repeats both with equal states."""
import os
import tempfile
import unittest

import rosbag
import rosnode
import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped
from vegetation_sim.msg import (BranchBreak, ContactForces, ErrorCode, ForestEvent, GrabStatus,
                                GrabStatuses, WindField)
from vegetation_sim.srv import CutBranch
from visualization_msgs.msg import MarkerArray

from forest_rig import RATE, TickClock, scene, time_of
from grab_rig import LIMB, OTHER_LIMB, TREE, Hands, plus, size, stamped, vector
from replaying import replay
from waiting import wait_for
from watched_node import Log

STRENGTH = 5.7e7  # [Pa] of the oak in picking.yaml
SCENARIO = os.path.join(os.path.dirname(scene('forest')), 'picking.yaml')


class Breaks(Hands):
    def __init__(self, clock, name='/forest_animator', namespace='/'):
        super().__init__(clock, name)
        self.breaks = Log(namespace + 'forest/breaks', BranchBreak)
        self.cut_branch = rospy.ServiceProxy(name + '/cut_branch', CutBranch)


class ForestBreaking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands = Breaks(cls.clock)
        cls.grabs = Log('/forest/grabs', GrabStatuses)
        cls.forces = Log('/forest/forces', ContactForces)
        cls.wind = Log('/wind', WindField)
        cls.trunks = Log('/forest/trunks', MarkerArray)
        cls.clock.begin(cls.hands)
        for log in (cls.grabs, cls.forces, cls.hands.breaks, cls.hands.events, cls.wind):
            wait_for(log.connected, log.topic)

    def status(self, grab):
        """Returns the status of the grab that has ended, or None."""
        newest = self.grabs.messages[-1] if self.grabs.messages else GrabStatuses()
        return next((g.status for g in newest.ended if g.grab.id == grab), None)

    def broken(self):
        """Returns the branches of each tree that the newest state lists as broken."""
        return {t.tree: [b.branch for b in t.broken]
                for t in self.hands.state.messages[-1].trees if t.broken}

    def refuse(self, code, text, **request):
        answer = self.hands.cut_branch(**request)
        self.assertFalse(answer.success)
        self.assertEqual(answer.error_code, code, answer.message)
        self.assertIn(text, answer.message)

    def break_a_limb(self):
        """Pulls a limb until it breaks, and checks what is reported. Returns the message."""
        answer, target = self.hands.take_at((0.0, 0.0, 0.0))
        start = target
        for step in range(30 * RATE):
            if self.broken():
                break
            self.hands.move_grab(id=answer.id, target=stamped(plus(start, (0.0, -0.004 * step, 0.0))))
            self.hands.run(1)
        broken = self.hands.breaks.wait(lambda all: all and all[-1], 'a break')
        self.assertEqual(broken.header.stamp, time_of(self.clock.tick))
        self.assertEqual((broken.tree, broken.piece.cut, list(broken.grabs)),
                         (TREE, False, [answer.id]))
        self.assertGreater(broken.stress, STRENGTH)
        self.assertGreater(broken.mass, 0.01)
        self.assertGreater(size(vector(broken.piece.twist.linear)), 0.0)
        self.grabs.wait(lambda _: self.status(answer.id) is not None, 'the end of the grab')
        self.assertEqual(self.status(answer.id), GrabStatus.BRANCH_BROKEN)
        self.assertIn('broke or was cut off', self.hands.move_grab(id=answer.id).message)
        force = self.forces.wait(lambda all: next(
            (f for m in all if m.header.stamp == broken.header.stamp
             for f in m.forces if f.grab == answer.id), None), 'the last force')
        self.assertGreater(size(vector(force.force)), 10.0)
        print('branch %d breaks at %.1f MPa, the hand feels %.0f N, the piece weighs %.2f kg' % (
            broken.piece.branch, 1e-6 * broken.stress, size(vector(force.force)), broken.mass))
        self.assertEqual(self.broken(), {TREE: [broken.piece.branch]})
        return broken

    def cut_a_limb(self, limb):
        """Cuts another limb at the point of a grab of it, and checks what is reported."""
        grab, _ = self.hands.take_at((0.0, 0.0, 0.0), branch=limb)
        self.hands.run(RATE)
        place = self.hands.point(limb, 0.3)
        answer = self.hands.cut_branch(nearest=True, point=stamped(place))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual((answer.tree, answer.branch), (TREE, limb))
        self.hands.run(1)
        cut = self.hands.breaks.wait(lambda all: len(all) == 3 and all[-1], 'the cut')
        self.assertEqual((cut.tree, cut.piece.branch, cut.piece.cut, list(cut.grabs)),
                         (TREE, limb, True, [grab.id]))
        self.assertEqual(cut.piece.stamp, time_of(self.clock.tick))
        self.grabs.wait(lambda _: self.status(grab.id) is not None, 'the end of the grab')
        self.assertEqual(self.status(grab.id), GrabStatus.BRANCH_BROKEN)

    def fell_a_tree(self, tree):
        """Cuts a trunk above its foot, and checks that its marker becomes a stump."""
        def height():
            return self.trunks.messages[-1].markers[tree + 1].scale.z
        wait_for(lambda: self.trunks.messages, 'trunks')
        whole = height()
        answer = self.hands.cut_branch(tree=tree, branch=1)
        self.assertTrue(answer.success, answer.message)
        self.clock.run_until(lambda: height() < 0.9 * whole, 'a stump', self.hands)
        self.assertAlmostEqual(height(), answer.point.z, delta=0.1 * whole)
        self.assertEqual(self.trunks.messages[-1].markers[tree + 2],
                         self.trunks.messages[0].markers[tree + 2])

    def expect_refusals(self, gone):
        tree = self.hands.tree(TREE)
        count = len(tree.parents)
        self.refuse(ErrorCode.UNKNOWN, 'tree = 9', tree=9, branch=1)
        self.refuse(ErrorCode.INVALID_VALUE, 'branch = 0', branch=0)
        self.refuse(ErrorCode.UNKNOWN, 'outside 1 to %d' % (count - 1), branch=count)
        self.refuse(ErrorCode.UNKNOWN, 'branch = %d of tree 0 has come off' % gone, branch=gone)
        self.refuse(ErrorCode.INVALID_VALUE, 'stamp', branch=1, stamp=rospy.Time(10 ** 9))
        self.refuse(ErrorCode.INVALID_VALUE, 'point', nearest=True,
                    point=PointStamped(point=Point(float('nan'), 0.0, 0.0)))
        self.refuse(ErrorCode.NOTHING_FOUND, 'point', nearest=True, point=stamped((90.0, 0.0, 1.0)))
        answer = self.hands.grab(tree=TREE, branch=gone, target=stamped((0.0, 0.0, 1.0)))
        self.assertIn('branch = %d' % gone, answer.message)
        self.assertEqual(answer.error_code, ErrorCode.UNKNOWN)

    def test_a_replay_repeats_a_break_and_a_cut(self):
        broken = self.break_a_limb()
        self.fell_a_tree(1)
        self.cut_a_limb(OTHER_LIMB)
        self.expect_refusals(broken.piece.branch)
        self.assertEqual(self.broken()[TREE], [broken.piece.branch, OTHER_LIMB])
        self.assertEqual([b.branch for b in self.hands.tree(TREE).broken],
                         [broken.piece.branch, OTHER_LIMB])
        self.hands.run(RATE)
        kinds = {e.kind for e in self.hands.events.messages}
        self.assertLessEqual({ForestEvent.GRAB, ForestEvent.MOVE, ForestEvent.CUT}, kinds)
        live, told = self.hands.states(), list(self.hands.breaks.messages)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        bag = os.path.join(folder.name, 'inputs.bag')
        with rosbag.Bag(bag, 'w') as out:
            for message in self.wind.messages:
                out.write('/wind', message, min(live))
            for message in self.hands.events.messages:
                out.write('/forest/events', message, message.header.stamp)
        rosnode.kill_nodes(['/wind_broadcaster', '/forest_animator'])
        again = Log('/replay/forest/breaks', BranchBreak)
        states = replay(bag, self.clock, SCENARIO, max(live))
        self.assertEqual([s for s in sorted(live) if states.get(s) != live[s]], [])
        self.assertEqual(again.wait(lambda all: len(all) >= len(told) and all, 'the breaks'), told)


if __name__ == '__main__':
    rospy.init_node('forest_breaking_test')
    rostest.rosrun('vegetation_sim', 'forest_breaking', ForestBreaking)
