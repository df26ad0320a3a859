#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Grabs a branch of the nearest tree, pulls it aside step by step while the force is below a limit,
and releases it. usage: arm_pulls.py _limit:=60.0 [N]"""
import math

import rospy
from vegetation_sim import Forest, VegetationError

STEP, STEPS = 0.02, 15  # [m]


def main():
    rospy.init_node('arm_pulls')
    limit = rospy.get_param('~limit', 60.0)
    forest = Forest()
    tree = next(forest.trees(centre=(0, 0), radius=100.0))
    # The last branch of the tree is one of its thinnest.
    branch = len(forest.tree(tree.id).parents) - 1
    try:
        with forest.grab(tree=tree.id, branch=branch, lease=2.0) as hold:
            x, y, z = hold.point
            for step in range(1, STEPS + 1):
                hold.move((x + step * STEP, y, z))
                rospy.sleep(0.2)
                force = math.hypot(*hold.force)
                rospy.loginfo('pulled %.2f m, force %.1f N', hold.point[0] - x, force)
                if force > limit:
                    break
        rospy.loginfo('released branch %d of tree %d', branch, tree.id)
    except VegetationError as error:
        rospy.logerr('%s', error)


if __name__ == '__main__':
    main()
