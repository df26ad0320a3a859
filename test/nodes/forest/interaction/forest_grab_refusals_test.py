#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""forest_animator rejects bad grabs and forces with an error that names field, value and range.
They have no effect."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import PointStamped, Vector3, Vector3Stamped

from vegetation_sim.srv import ApplyForce, GetTree, Grab, MoveGrab, Release

from forest_rig import RATE, TickClock, time_of
from given import given
from grab_rig import LIMB, TREE, Hands, plus, stamped
from waiting import wait_for
from watched_node import serves

NAN, INF = float('nan'), float('inf')
TREES = 7


class ForestGrabRefusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.hands = Hands(cls.clock)
        cls.clock.begin(cls.hands)
        cls.clock.run(5 * RATE, cls.hands)

    def setUp(self):
        self.hash = self.hands.state.messages[-1].hash
        self.events = len(self.hands.events.messages)
        self.here = self.hands.point(LIMB, 0.1)

    def tearDown(self):
        self.clock.run(3, self.hands)
        self.assertEqual(self.hands.state.messages[-1].hash, self.hash)
        self.assertEqual(len(self.hands.events.messages), self.events)
        self.assertEqual(self.hands.physical(), [])

    def expect(self, service, cases):
        for request, text in cases:
            with self.subTest(text=text):
                answer = service(**request)
                self.assertFalse(answer.success, request)
                self.assertIn(text, answer.message.replace('-nan', 'nan'))

    def good(self, **changes):
        return dict(dict(tree=TREE, branch=LIMB, along=0.1, target=stamped(self.here)), **changes)

    def test_grab(self):
        odom = PointStamped(point=stamped(self.here).point)
        odom.header.frame_id = 'nowhere'
        far = stamped(plus(self.here, (1000.0, 0.0, 0.0)))
        last = time_of(self.clock.tick)
        self.expect(self.hands.grab, [
            (self.good(tree=99), 'tree = 99 is unknown; there are %d, from 0' % TREES),
            (self.good(jaw_length=-0.1), 'jaw_length = -0.1 m is outside 0 to 1'),
            (self.good(jaw_length=1.5), 'jaw_length = 1.5 m is outside 0 to 1'),
            (self.good(jaw_length=NAN), 'jaw_length = nan'),
            (self.good(branch=99999), 'branch = 99999 is unknown; tree 0 has 707, from 0'),
            (self.good(along=-0.1), 'along = -0.1 m is outside 0 to'),
            (self.good(along=9.0), 'along = 9 m is outside 0 to'),
            (self.good(along=NAN), 'along = nan m is not finite'),
            (self.good(target=stamped((NAN, 0.0, 0.0))), 'target.x = nan m is not finite'),
            (self.good(target=far),
             'target, its distance from the point held, = 1000 m is outside 0 to 10 m'),
            (self.good(target=odom), "target.frame_id = 'nowhere' is not known in 'map'"),
            (self.good(frame='nowhere'), "frame = 'nowhere' is not known in 'map'"),
            (self.good(**given(stiffness=-5.0)), 'stiffness = -5 N/m is outside 1 to 1e+06 N/m'),
            (self.good(**given(damping=NAN)), 'damping = nan N s/m is not finite'),
            (self.good(**given(force_limit=1e9)), 'force_limit = 1e+09 N is outside 0.01 to 100000 N'),
            (self.good(**given(lease=INF)), 'lease = inf s is not finite'),
            (self.good(**given(lease=-1.0)), 'lease = -1 s is outside 0.1 to 3600 s'),
            (self.good(**given(stiffness=0.0)), 'stiffness = 0 N/m is outside 1 to 1e+06 N/m'),
            (self.good(stiffness=500.0), 'stiffness = 500 needs has_stiffness = true'),
            (self.good(damping=NAN), 'damping = nan needs has_damping = true'),
            (self.good(force_limit=-1.0, lease=2.0),
             'force_limit = -1 needs has_force_limit = true\nlease = 2 needs has_lease = true'),
            (self.good(stamp=last - rospy.Duration(1)), 'ahead of the last tick, = -1 s is outside 0'),
            (self.good(stamp=last + rospy.Duration(100)), '= 100 s is outside 0 to 60 s'),
            (self.good(nearest=True, point=stamped((500.0, 0.0, 0.0))),
             'no branch within 2 m of point'),
            (self.good(nearest=True, point=stamped((0.0, INF, 0.0))), 'point.y = inf m is not finite'),
        ])
        all_at_once = self.hands.grab(**self.good(**given(stiffness=-1.0, lease=NAN))).message
        for name in ('stiffness', 'lease'):
            self.assertIn(name, all_at_once)

    def test_move_and_release(self):
        self.expect(self.hands.move_grab,
                    [(dict(id=77, target=stamped(self.here)), 'id = 77 is unknown; nothing is held')])
        self.expect(self.hands.release, [(dict(id=77), 'id = 77 is unknown; nothing is held')])
        self.assertEqual(self.hands.release(all=True).message, '0 released')

    # A rejected request leaves the grab unchanged.
    def test_bad_moves_of_a_good_grab(self):
        start = time_of(self.clock.tick + 50 * RATE)
        held = self.hands.take(**self.good(stamp=start))
        self.expect(self.hands.move_grab, [
            (dict(id=held.id, target=stamped((0.0, NAN, 0.0)), stamp=start),
             'target.y = nan m is not finite'),
            (dict(id=held.id, target=stamped(plus(self.here, (0.0, 0.0, 1000.0))), stamp=start),
             'its distance from the point held, = 1000 m is outside 0 to 10 m'),
            (dict(id=held.id + 1), 'id = %d is unknown; held are %d' % (held.id + 1, held.id)),
        ])
        self.assertTrue(self.hands.release(id=held.id).success)

    # A request that the forest would reject at its tick is rejected when it arrives.
    def test_requests_that_every_tick_would_reject(self):
        def service(node, name, kind):
            topic = '/%s/%s/%s' % (node, node, name)
            # A node serves once the clock has reached it.
            wait_for(lambda: self.clock.run(1, self.hands) or serves(topic), topic)
            return rospy.ServiceProxy(topic, kind)
        get_trees = {n: service(n, 'get_tree', GetTree) for n in ('paper', 'far')}

        def ticks():
            self.clock.run(1, self.hands)
            return all(get_tree(tree=0).success for get_tree in get_trees.values())
        wait_for(ticks, 'the other nodes')
        paper = dict(tree=0, branch=0, along=0.0, target=stamped((0.0, 0.0, 0.0)))
        text = 'joint_model = paper has no physical motion, allowed is swing'
        self.expect(service('paper', 'grab', Grab), [(paper, 'grab: ' + text)])
        push = dict(tree=0, branch=0, along=0.0, duration=1.0,
                    force=Vector3Stamped(vector=Vector3(1.0, 0.0, 0.0)))
        self.expect(service('paper', 'apply_force', ApplyForce), [(push, 'push: ' + text)])

        away = self.good(target=stamped(plus(self.here, (0.0, 0.0, 500.0))))
        text = "distance of target from the tree's foot = 50"
        grab, move = service('far', 'grab', Grab), service('far', 'move_grab', MoveGrab)
        self.expect(grab, [(away, text)])
        near = grab(**self.good())
        self.assertTrue(near.success, near.message)
        self.expect(move, [(dict(id=near.id, target=away['target']), text)])
        self.assertTrue(service('far', 'release', Release)(id=near.id).success)

    def test_apply_force(self):
        def good(**changes):
            force = Vector3Stamped(vector=Vector3(1.0, 0.0, 0.0))
            return dict(dict(tree=TREE, branch=LIMB, along=0.1, force=force, duration=1.0), **changes)
        self.expect(self.hands.apply_force, [
            (good(tree=99), 'tree = 99 is unknown'),
            (good(branch=99999), 'branch = 99999 is unknown'),
            (good(along=9.0), 'along = 9 m is outside 0 to'),
            (good(duration=0.0), 'duration = 0 s is outside 0.001 to 3600 s'),
            (good(duration=NAN), 'duration = nan s is not finite'),
            (good(force=Vector3Stamped(vector=Vector3(0.0, NAN, 0.0))), 'force.y = nan N is not finite'),
            (good(force=Vector3Stamped(vector=Vector3(1e9, 0.0, 0.0))),
             'force.x = 1e+09 N is outside -100000 to 100000'),
        ])


if __name__ == '__main__':
    rospy.init_node('forest_grab_refusals_test')
    rostest.rosrun('vegetation_sim', 'forest_grab_refusals', ForestGrabRefusals)
