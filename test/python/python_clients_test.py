#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Python clients hold branches, ask and tell the nodes, and report errors. Every snippet of
docs/python.md runs."""
import math
import re
import threading
import unittest

import roslib.packages
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim import Crowd, Forest, Grass, Plants, Sky, VegetationError, Wind
from vegetation_sim.msg import AgentStates, ErrorCode, GrabStatus, SkyView

TREE, LIMB = 0, 46
DEADLINE = 60.0  # [s]


def snippets(document):
    """Returns the indented blocks of a page."""
    lines = open('%s/docs/%s' % (roslib.packages.get_pkg_dir('vegetation_sim'), document)).readlines()
    blocks, block = [], []
    for line in lines + ['end']:
        if line.startswith('    ') or (block and not line.strip()):
            block.append(line[4:] or '\n')
        elif block:
            blocks.append(''.join(block))
            block = []
    return blocks


def wait_for(condition, what):
    end = rospy.Time.now() + rospy.Duration.from_sec(DEADLINE)
    while not condition():
        if rospy.Time.now() > end:
            raise AssertionError('timed out waiting for ' + what)
        threading.Event().wait(0.02)


class PythonClients(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        gripper = TransformStamped(child_frame_id='gripper')
        gripper.header.frame_id = 'map'
        at, gripper.transform.rotation.w = gripper.transform.translation, 1.0
        at.x, at.y, at.z = -0.6, -0.8, 2.8
        cls.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.frames.publish([gripper])
        cls.forest, cls.wind, cls.grass, cls.crowd = Forest(), Wind(), Grass(), Crowd()
        cls.sky = Sky()

    def held(self):
        return {status.grab.id for status in self.forest.grabs().held}

    def status_of(self, grab):
        return [s.status for s in self.forest.grabs().ended if s.grab.id == grab]

    def test_a_grab_follows_its_target_and_reports_the_force(self):
        with self.forest.grab(tree=TREE, branch=LIMB, along=0.3, stiffness=20000.0, damping=200.0,
                              force_limit=5000.0) as hold:
            start = hold.point
            self.assertEqual((hold.tree, hold.branch, hold.along), (TREE, LIMB, 0.3))
            calm = hold.force
            target = (start[0] + 0.2, start[1], start[2])
            hold.move(target)
            wait_for(lambda: math.dist(hold.point, target) < 0.1, 'the branch to follow')
            self.assertLess(hold.force[0], calm[0] - 100.0)  # It pulls back.
            grab = hold.id
        wait_for(lambda: grab not in self.held(), 'the release')
        self.assertEqual(self.status_of(grab), [GrabStatus.RELEASED])

    def test_the_lease_is_renewed_and_an_exception_releases(self):
        with self.assertRaises(ZeroDivisionError):
            with self.forest.grab(tree=TREE, branch=LIMB, lease=0.5) as hold:
                wait_for(lambda: hold.id in self.held(), 'the grab')
                begin = rospy.Time.now()
                wait_for(lambda: rospy.Time.now() - begin > rospy.Duration(2), 'four leases')
                self.assertIn(hold.id, self.held())
                1 / 0
        wait_for(lambda: hold.id not in self.held(), 'the release')

    def test_a_hold_that_has_ended_raises_the_message_of_the_service(self):
        hold = self.forest.grab(tree=TREE, branch=LIMB)
        self.forest.release_all()
        wait_for(lambda: self.status_of(hold.id) == [GrabStatus.RELEASED], 'the release')
        with self.assertRaisesRegex(VegetationError, 'move_grab: id = %d has been' % hold.id):
            hold.move((0, 0, 0))
        with self.assertRaisesRegex(VegetationError, 'release: id = %d has been released' % hold.id):
            hold.release()

    def test_the_result_of_a_hold_is_the_reason_why_it_ended(self):
        with self.forest.grab(tree=TREE, branch=LIMB) as hold:
            wait_for(lambda: hold.id in self.held(), 'the grab')
            self.assertIsNone(hold.result(timeout=0.1))
        result = hold.result()
        self.assertEqual((result.status, result.grab.id), (GrabStatus.RELEASED, hold.id))
        self.assertLess(result.since, result.until)
        lost = self.forest.grab(tree=TREE, branch=LIMB, lease=0.5)
        lost._timer.shutdown()  # as if the program had died
        self.assertEqual(lost.result(DEADLINE).status, GrabStatus.LEASE_EXPIRED)

    def test_errors_are_the_messages_of_the_services(self):
        cases = [
            (lambda: self.forest.grab(tree=99, branch=0), 'tree = 99 is unknown', ErrorCode.UNKNOWN),
            (lambda: self.forest.grab(tree=TREE, branch=LIMB, stiffness=0.0),
             'stiffness = 0 N/m is outside'),
            (lambda: self.forest.grab(frame='nowhere'), "'nowhere' is not known",
             ErrorCode.NO_TRANSFORM),
            (lambda: self.forest.push((1e9, 0, 0), 1.0, tree=TREE, branch=LIMB), 'force.x = 1e'),
            (lambda: list(self.forest.trees((0, 0), -1.0)), 'radius = -1 m is outside'),
            (lambda: self.wind.breeze((900, 0, 0)), 'velocity.x = 900 m/s is outside'),
            (lambda: self.wind.remove('nothing'), "no source is named 'nothing'",
             ErrorCode.UNKNOWN),
            (lambda: self.grass.tread((0, 0), radius=0.0), 'radius = 0 m is outside'),
            (lambda: self.grass.clear((0, 0), -1.0), 'radius = -1 m is outside'),
            (lambda: self.grass.cut((0, 0), radius=1.0, height=-1.0), 'height = -1 m is outside'),
            (lambda: self.grass.cut((0, 0), radius=-2.0, height=0.1), 'radius = -2 m is outside'),
            (lambda: self.grass.cut((1e4, 0), radius=1.0, height=0.1), 'is beyond the meadow'),
            (lambda: self.crowd.spawn((0, 0), count=0), 'count = 0 is outside'),
            (lambda: self.crowd.send([9999], (0, 0)), 'walker 9999 is unknown',
             ErrorCode.UNKNOWN),
            (lambda: self.sky.at(), 'points and frames have 0 entries'),
            (lambda: self.sky.of('nowhere'), "frames[0]: frame_id = 'nowhere'",
             ErrorCode.NO_TRANSFORM),
        ]
        for call, text, *code in cases:
            with self.subTest(text=text):
                with self.assertRaisesRegex(VegetationError, re.escape(text)) as raised:
                    call()
                self.assertEqual([raised.exception.code], code or [ErrorCode.INVALID_VALUE])
        for call in (lambda: self.forest.grab(), lambda: self.forest.grab(tree=3),
                     lambda: self.forest.grab(tree=3, branch=0, near=(0, 0, 1)),
                     lambda: self.forest.grab(near=(0, 0)),
                     lambda: self.forest.grab(frame='hand', target=(0, 0, 1)),
                     lambda: list(self.forest.trees(radius=2.0)),
                     lambda: list(self.forest.trees(centre=(0, 0))),
                     lambda: self.grass.clear(radius=2.0), lambda: self.grass.clear((0, 0))):
            with self.assertRaises(ValueError):
                call()

    def test_a_service_that_does_not_come_is_named(self):
        with self.assertRaisesRegex(VegetationError,
                                    'no service /nobody/get_tree within 0.1 s') as raised:
            Forest('/nobody', timeout=0.1).tree(0)
        self.assertIsNone(raised.exception.code)

    def test_damping_of_zero_and_defaults_reach_the_node(self):
        with self.forest.grab(tree=TREE, branch=LIMB, damping=0.0) as hold:
            wait_for(lambda: hold.id in self.held(), 'the grab')
            grab = next(g.grab for g in self.forest.grabs().held if g.grab.id == hold.id)
        self.assertEqual((grab.stiffness, grab.damping, grab.force_limit), (2000.0, 0.0, 200.0))

    def test_wind_grass_and_people(self):
        self.grass.tread((-5, 1), (5, 1), radius=0.3, recovery=1e9)
        wait_for(lambda: self.grass.at((0, 1))[0].crush > 0.9, 'the track')
        self.grass.clear()
        wait_for(lambda: self.grass.at((0, 1))[0].crush == 0.0, 'grass that stands')
        self.grass.cut((-1, 0), (1, 0), (1, 2), (-1, 2), height=0.01)
        wait_for(lambda: self.grass.at((0, 1))[0].cut, 'stubble')
        self.grass.set_cutting(False)
        self.grass.set_cutting(True)
        # The breeze of the scenario alone stays below 6 m/s.
        self.wind.breeze((7, 0, 0), turbulence=0.0, name='steady')
        wait_for(lambda: self.wind.at((0, 0, 2))[0][0] > 7.0, 'the wind')
        self.wind.remove('steady')
        ids = self.crowd.spawn((5, 6), count=2, spread=0.5, stands=True)
        self.assertEqual(len(ids), 2)

        def known():
            try:
                self.crowd.wander(ids)
                return True
            except VegetationError:
                return False
        wait_for(known, 'the walkers')
        self.crowd.remove(ids)

    def test_plants_are_cut_once(self):
        plants = Plants()
        # Lower than the page of the clients cuts it.
        self.assertEqual(plants.cut((2.0, 0.3), radius=0.3, height=0.2), 1)
        wait_for(lambda: plants.cut((2.0, 0.3), radius=0.3, height=0.2) == 0, 'the cut')
        plants.set_cutting(False)
        plants.set_cutting(True)
        with self.assertRaisesRegex(VegetationError, 'height = 7 m is outside 0 to 5 m') as raised:
            plants.cut((2.0, 0.3), radius=0.3, height=7.0)
        self.assertEqual(raised.exception.code, ErrorCode.INVALID_VALUE)

    def test_the_sky_is_open_above_a_tree_and_not_beside_its_trunk(self):
        wait_for(lambda: self.sky.at((0.5, 0.2, 1))[0].sky_view_factor < 0.8, 'the tree')
        under, above = self.sky.at((0.5, 0.2, 1), (0, 0, 40))
        self.assertAlmostEqual(above.sky_view_factor, 1.0, places=5)
        self.assertLess(under.open_share, 0.9)
        at = self.sky.of('gripper')[0].position
        self.assertEqual((at.x, at.y, at.z), (-0.6, -0.8, 2.8))

    def test_a_direction_is_that_of_its_bin(self):
        view = SkyView(transmittance=list(range(216)))
        for elevation, azimuth, bin in ((0.0, 0.0, 0), (0.01, -0.01, 23), (0.2, 7.0, 26),
                                        (math.pi / 2, math.pi, 204)):
            self.assertEqual(Sky.transmittance(view, elevation, azimuth), bin)
        for elevation, azimuth in ((-0.1, 0.0), (1.6, 0.0), (math.nan, 0.0), (0.5, math.inf)):
            with self.assertRaises(ValueError):
                Sky.transmittance(view, elevation, azimuth)

    def reset(self, node):
        answer = rospy.ServiceProxy(node + '/reset', Trigger)()
        self.assertTrue(answer.success, answer.message)

    def test_clear_removes_all_sources_of_wind(self):
        self.addCleanup(self.reset, '/wind_broadcaster')
        for name in 'first', 'second':
            self.wind.breeze((3, 0, 0), turbulence=0.0, name=name)
        wait_for(lambda: self.wind.at((0, 0, 2))[0][0] > 6.0, 'the wind of both')
        self.wind.clear()
        wait_for(lambda: self.wind.at((0, 0, 2)) == [(0.0, 0.0, 0.0)], 'still air')

    def test_clear_removes_all_people(self):
        def people():
            return rospy.wait_for_message('/agents', AgentStates, DEADLINE).agents
        self.addCleanup(self.reset, '/agent_crowd')
        wait_for(people, 'the people of the scenario')
        ids = self.crowd.spawn((5, 6), count=2, spread=0.5)
        wait_for(lambda: set(ids) <= {agent.id for agent in people()}, 'two more')
        self.crowd.clear()
        wait_for(lambda: not people(), 'an empty hall')

    def test_every_snippet_of_the_page_runs(self):
        blocks = snippets('python.md')
        self.assertGreaterEqual(len(blocks), 5)
        names = {}
        for block in blocks:
            code = '\n'.join(line for line in block.split('\n') if 'rospy.init_node' not in line)
            with self.subTest(code=code):
                exec(compile(code, 'docs/python.md', 'exec'), names)

    def test_a_grab_takes_at_most_eight_lines(self):
        path = roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/tutorials/4_arm.md'
        with open(path) as page:
            whole_program = re.search('```python\n(.*?)```', page.read(), re.S).group(1)
        for block in next(b for b in snippets('python.md') if 'hold.force' in b), whole_program:
            self.assertLessEqual(len(block.strip().split('\n')), 8, block)


if __name__ == '__main__':
    rospy.init_node('python_clients_test')
    rostest.rosrun('vegetation_sim', 'python_clients', PythonClients)
