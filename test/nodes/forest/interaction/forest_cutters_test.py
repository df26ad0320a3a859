#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tools on tf frames trim the trees of forest_animator: a bar takes off the branches that are thin
enough and that it meets, and no others; events, breaks, limits, a snapshot, and a replay with the
same hashes."""
import unittest

import rospy
import rostest
from std_srvs.srv import SetBool, Trigger
from vegetation_sim.msg import BranchBreak, ForestEvent
from vegetation_sim.srv import LoadSnapshot, SaveSnapshot

from crowd_rig import Cart
from forest_rig import RATE, Animator, TickClock, time_of
from grab_rig import along_z
from replaying import compare_replay
from watched_node import Log

BEGIN = 1000 * RATE
HEIGHT, HALF_LENGTH, HALF_WIDTH = 1.3, 0.15, 0.4  # of the bar [m]
THICKEST = 0.0024  # [m]
FROM, TO = -0.6, 0.25  # x of the first vine that the bar passes [m]
MARGIN = 0.008  # [m] by which a branch, up to 4 mm in radius, is surely met or missed
MOST = 256  # cuts of tools in a tick
FIRST_OF_FIELD = 2  # number of the first vine of the field


class Vine:
    """A tree at one stamp."""

    def __init__(self, answer):
        self.parents, self.lengths, self.radii = answer.parents, answer.lengths, answer.radii
        self.poses = answer.transforms.poses
        self.gone, self.pieces = {b.branch for b in answer.broken}, len(answer.broken)
        for i, parent in enumerate(self.parents):
            if parent in self.gone:
                self.gone.add(i)

    def meets(self, branch, margin):
        """Returns whether points of the branch are in the box that the bar sweeps, larger by
        `margin`."""
        for k in range(401):
            x, y, z = along_z(self.poses[branch], self.lengths[branch] * k / 400)
            if (abs(z - HEIGHT) <= 0.01 + margin and abs(y) <= HALF_WIDTH + margin and
                    FROM - HALF_LENGTH - margin <= x <= TO + HALF_LENGTH + margin):
                return True
        return False

    def is_thick(self, branch):
        """Returns whether the branch is too thick all along: its radius falls to that of the next
        piece."""
        return any(self.parents[i] == branch and radius > THICKEST and
                   radius > 0.6 * self.radii[branch] for i, radius in enumerate(self.radii))

    def carriers(self, branch):
        """Returns the branch and all below it."""
        while branch >= 0:
            yield branch
            branch = self.parents[branch]


class ForestCutters(unittest.TestCase):
    def setUp(self):
        self.clock = TickClock(BEGIN)
        self.forest = Animator()
        self.again = Animator('/again/forest_animator', '/again/')
        self.again.events = self.forest.events
        self.breaks = [Log(name + '/forest/breaks', BranchBreak) for name in ('', '/again')]
        self.again.wait_until_up('/wind', '/forest/events')
        self.clock.begin(self.forest)
        for log in self.breaks:
            log.wait(lambda _: log.connected(), 'the connection of ' + log.topic)
        self.run_ticks(10)
        self.cart, self.saw = Cart(self.forest), Cart(self.forest, 'saw')
        self.switch = rospy.ServiceProxy('/forest_animator/cutting', SetBool)

    def run_ticks(self, count):
        """Runs single ticks; before each one the replay has received the events of the previous
        tick."""
        for _ in range(count):
            self.clock.run(1, self.forest)
            self.again.settle()

    def vine(self, tree):
        return Vine(self.forest.tree(tree))

    def cuts(self, stamp=None):
        """Returns the cuts of all ticks or of one, in order."""
        return [(e.cut.tree, e.cut.branch) for e in self.forest.events.messages
                if e.kind == ForestEvent.CUT and stamp in (None, e.header.stamp)]

    def drive(self, first, last, steps):
        """Drives the bar along the row, and away."""
        for i in range(steps + 1):
            self.cart.put(first + (last - first) * i / steps, 0.0, time_of(self.clock.tick + 1))
            self.run_ticks(1)
        self.cart.put(500.0, 0.0, time_of(self.clock.tick + 1))
        self.run_ticks(2)

    def test_tools_cut_thin_branches(self):
        self.expect_no_cut_when_off()
        self.expect_a_trimmed_vine()
        self.expect_a_snapshot()
        self.expect_a_bounded_tick()
        self.expect_equal_replay()

    def expect_no_cut_when_off(self):
        again = rospy.ServiceProxy('/again/forest_animator/cutting', SetBool)
        self.assertIn('replay', again(False).message)
        self.assertTrue(self.switch(False).success)
        self.drive(FROM, TO, 5)
        self.assertEqual(self.vine(0).gone, set())
        self.assertTrue(self.switch(True).success)

    def expect_a_trimmed_vine(self):
        before, other = self.vine(0), self.vine(1)
        self.assertEqual(before.gone, set())
        branches = range(1, len(before.parents))
        thick = {b for b in branches if before.is_thick(b)}
        sure = {b for b in branches if before.radii[b] < THICKEST and before.meets(b, -MARGIN)}
        possible = {b for b in branches if before.meets(b, MARGIN)} - thick
        self.drive(FROM, TO, 5)
        after = self.vine(0)
        self.assertGreater(len(sure), 2)
        self.assertLess(len(possible), len(before.parents) // 2)
        self.assertEqual(sorted(sure - after.gone), [])
        taken = {b for b in branches if possible & set(before.carriers(b))}
        self.assertEqual(sorted(after.gone - taken), [])
        # Wood in the way of the bar that is thicker stays.
        stays = {b for b in thick if before.meets(b, -MARGIN)}
        self.assertGreater(len(stays), 1)
        self.assertEqual(sorted(stays & after.gone), [])
        # The second vine is met by nothing.
        self.assertEqual(self.vine(1).gone, set())
        self.assertEqual(other.gone, set())
        cuts = self.forest.events.wait(
            lambda _: len(self.cuts()) == after.pieces and self.cuts(), 'the events')
        self.assertEqual({tree for tree, _ in cuts}, {0})
        self.assertEqual(len(cuts), len(set(cuts)))
        for stamp in {e.header.stamp for e in self.forest.events.messages}:
            self.assertEqual(self.cuts(stamp), sorted(self.cuts(stamp)))
        pieces = self.breaks[0].wait(lambda all: len(all) == len(cuts) and all, 'the breaks')
        self.assertEqual([(p.tree, p.piece.branch, p.piece.cut) for p in pieces],
                         [cut + (True,) for cut in cuts])
        figures = self.forest.diagnostics()
        self.assertEqual(figures['Branches that have come off'], len(cuts))
        self.assertEqual(figures['Branches that tools have left uncut'], 0)
        print('%d of %d branches are cut off in %d pieces' % (
            len(after.gone), len(before.parents), len(cuts)))

    def expect_a_snapshot(self):
        gone = self.vine(0).gone
        self.assertTrue(self.switch(False).success)
        saved = rospy.ServiceProxy('/forest_animator/save_snapshot', SaveSnapshot)(name='cut')
        self.assertTrue(saved.success, saved.message)
        self.assertTrue(self.switch(True).success)
        self.assertTrue(rospy.ServiceProxy('/forest_animator/reset', Trigger)().success)
        self.run_ticks(2)
        self.assertEqual(self.vine(0).gone, set())
        loaded = rospy.ServiceProxy('/forest_animator/load_snapshot', LoadSnapshot)(name='cut')
        self.assertTrue(loaded.success, loaded.message)
        self.again.settle()
        self.run_ticks(2)
        self.assertEqual(self.vine(0).gone, gone)
        self.drive(1.3, 3.1, 6)  # tools are off again
        self.assertEqual(self.vine(1).gone, set())
        self.assertTrue(self.switch(True).success)
        self.drive(1.3, 3.1, 6)
        self.assertGreater(len(self.vine(1).gone), 1)

    def expect_a_bounded_tick(self):
        """A saw that stands across the vines of a field cuts the shoots that it meets in several
        ticks."""
        cut = []
        for _ in range(2):
            self.saw.put(0.0, 30.0, time_of(self.clock.tick + 1))
            self.run_ticks(1)
            stamp = time_of(self.clock.tick)
            cut.append(self.forest.events.wait(
                lambda _: len(self.cuts(stamp)) == MOST and self.cuts(stamp), 'the cuts'))
        self.assertGreaterEqual(min(cut[0])[0], FIRST_OF_FIELD)
        self.assertGreater(len({tree for tree, _ in cut[0] + cut[1]}), 20)
        self.assertEqual(cut[0], sorted(cut[0]))
        self.assertEqual(set(cut[0]) & set(cut[1]), set())
        self.assertGreater(self.forest.diagnostics()['Branches that tools have left uncut'], 0)
        self.saw.put(500.0, 30.0, time_of(self.clock.tick + 1))

    def expect_equal_replay(self):
        self.run_ticks(RATE)
        states, different = compare_replay(
            self, lambda: (self.forest.states(), self.again.states()))
        self.assertGreater(states, 2 * RATE)
        self.assertEqual(different, [])
        told = [p for p in self.breaks[0].messages]
        self.assertEqual(self.breaks[1].wait(lambda all: len(all) >= len(told) and all, 'the breaks'),
                         told)


if __name__ == '__main__':
    rospy.init_node('forest_cutters_test')
    rostest.rosrun('vegetation_sim', 'forest_cutters', ForestCutters)
