#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""dynamic_reconfigure changes a forest while it runs (S1-10, S1-45)."""
import math
import unittest

import rospy
import rostest
import yaml
from dynamic_reconfigure.client import Client
from vegetation_sim.msg import ForestEvent
from vegetation_sim.srv import Grab

from forest_rig import RATE, Animator, TickClock, time_of

OAK = 0  # index of the tree
PLAIN = dict(size=1.0, children=1.0, leaves=1.0, angle=1.0, noise=1.0, fixed_level=2,
             highest_level=6, transition=2.0)


def axis(pose):
    """Returns the z axis of a frame in the world."""
    q = pose.orientation
    return (2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
            1 - 2 * (q.x * q.x + q.y * q.y))


def joint_angles(tree, depth):
    """Returns the rest angles between limbs of a depth and their parents [rad]."""
    axes = [axis(pose) for pose in tree.transforms.poses]
    return [math.acos(max(-1.0, min(1.0, sum(a * b for a, b in zip(axes[i], axes[parent])))))
            for i, parent in enumerate(tree.parents) if parent >= 0 and tree.depths[i] == depth]


def mean(values):
    return sum(values) / len(values)


class ForestTuning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.clock = TickClock(1000 * RATE)
        cls.forest.wait_until_up()
        cls.clock.run(1, cls.forest)
        cls.server = Client('/forest_animator', timeout=30)

    def setUp(self):
        self.tune(**PLAIN)
        self.plain = self.forest.tree(OAK)

    def tune(self, **settings):
        """Changes settings and runs the tick at which they take effect."""
        self.server.update_configuration(settings)
        self.clock.run(1, self.forest)

    def newest_layout(self):
        """Returns the layout of the newest state."""
        wanted = self.forest.state.messages[-1].layout_hash
        return self.forest.layout.wait(lambda all: all[-1].hash == wanted and all[-1], 'a layout')

    def rules(self):
        return yaml.safe_load(self.newest_layout().species[0].rules)

    # Trees of another design have other branches, so nothing can stay held.
    def test_a_design_that_ends_grabs_says_so(self):
        grab = rospy.ServiceProxy('/forest_animator/grab', Grab)
        answer = grab(tree=OAK, branch=1, along=0.1, has_lease=True, lease=60.0)
        self.assertTrue(answer.success, answer.message)
        self.clock.run(1, self.forest)
        before = self.forest.diagnostics()['Grabs ended by a new design']
        self.tune(children=0.5)
        diagnostics = self.forest.diagnostics()
        self.assertEqual(diagnostics['Grabs'], 0)
        self.assertEqual(diagnostics['Grabs ended by a new design'], before + 1)

    # S1-10: each parameter has the documented effect.
    def test_size_scales_the_trees(self):
        self.tune(size=1.5)
        self.assertAlmostEqual(self.forest.tree(OAK).height / self.plain.height, 1.5, delta=0.1)

    def test_children_multiply_the_branches(self):
        few, plain, many = 0, len(self.plain.parents), 0
        self.tune(children=0.5)
        few = len(self.forest.tree(OAK).parents)
        self.tune(children=1.5)
        many = len(self.forest.tree(OAK).parents)
        self.assertLess(few, 0.5 * plain)
        self.assertGreater(many, 1.5 * plain)

    def test_leaves_multiply_the_leaves(self):
        before = [limb['leaves'] for limb in self.rules()['limbs']]
        self.tune(leaves=2.0)
        self.assertEqual([limb['leaves'] for limb in self.rules()['limbs']],
                         [2 * leaves for leaves in before])
        self.assertGreater(sum(before), 0)

    def test_angle_opens_the_limbs(self):
        self.tune(angle=0.5)
        self.assertLess(mean(joint_angles(self.forest.tree(OAK), 1)),
                        0.8 * mean(joint_angles(self.plain, 1)))

    # S1-12: without noise the trunk is straight.
    def test_noise_makes_the_growth_irregular(self):
        self.tune(noise=0.0)
        self.assertLess(max(joint_angles(self.forest.tree(OAK), 0)), 1e-6)
        self.assertGreater(max(joint_angles(self.plain, 0)), 0.02)

    def test_a_changed_forest_is_a_new_layout(self):
        before = self.newest_layout()
        tick = self.clock.tick
        self.tune(size=0.7)
        layout = self.newest_layout()
        self.assertNotEqual(layout.hash, before.hash)
        state = self.forest.state.messages[-1]
        self.assertEqual((state.layout_hash, state.key_frame), (layout.hash, True))
        event = self.forest.events.wait_for_stamp(time_of(tick + 1))
        self.assertEqual(event.kind, ForestEvent.SETTINGS)
        self.assertEqual(dict(zip(event.names, event.values))['size'], 0.7)
        self.tune(size=1.0)
        self.assertEqual(self.newest_layout().hash, before.hash)
        self.assertEqual(self.forest.tree(OAK).skeleton_hash, self.plain.skeleton_hash)

    def ticks_of_a_change(self, level):
        """Returns the number of ticks until the trees have reached another fixed level."""
        self.tune(fixed_level=level)
        start = self.clock.tick
        self.assertEqual(self.forest.level(OAK), level)

        def settled():
            held = [m for m in self.forest.state.messages if m.key_frame][-1]
            return held.header.stamp > time_of(start) and not held.trees and not held.base_blend
        self.clock.run_until(settled, 'a settled forest', self.forest)
        return self.clock.tick - start

    # S1-45: a longer transition takes longer. Without a viewer the fixed level applies (N8).
    def test_transition_and_fixed_level_take_effect(self):
        self.clock.run(5 * RATE, self.forest)
        long = self.ticks_of_a_change(3)
        self.assertGreaterEqual(long, 2 * RATE)  # The scenario sets 2 s.
        self.tune(transition=0.2)
        self.clock.run(RATE, self.forest)
        short = self.ticks_of_a_change(1)
        # The key frame that shows it may come up to a second later.
        self.assertLessEqual(short, 1.2 * RATE + 1)
        self.assertEqual(self.newest_layout().transition, 0.2)

    def test_highest_level_limits_the_fixed_one(self):
        self.tune(fixed_level=5, highest_level=1)
        self.assertEqual(self.forest.level(OAK), 1)


if __name__ == '__main__':
    rospy.init_node('forest_tuning_test')
    rostest.rosrun('vegetation_sim', 'forest_tuning', ForestTuning)
