#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Scene: all nodes of the demo continue from one snapshot with the same hashes."""
import hashlib
import json
import os
import re
import shutil
import struct
import tempfile
import time
import unittest

import roslib.packages
import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped
from vegetation_sim import Crowd, Grass, Scene, Simulation, VegetationError
from vegetation_sim.msg import AgentStates, CanopyState, ErrorCode, ForestState, GrassState
from vegetation_sim.srv import GetTree, Grab, LoadSnapshot, SaveSnapshot

from forest_rig import scene, start_node, stop
from waiting import wait_for
from watched_node import listens

WAIT = 5.0  # frame_wait of the nodes [s]
NODES = {
    'wind_broadcaster': {}, 'forest_animator': {}, 'canopy_animator': {'frame_wait': WAIT},
    'grass_field': {'frame_wait': WAIT},
    'agent_crowd': {'frame_wait': WAIT, 'cover_rate': 2.0},
}
SAVED, LATER = 90, 600


class SceneTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        demo = os.path.join(os.path.dirname(scene('forest')), 'demo.yaml')
        cls.processes = [start_node(node, '/scene/' + node, {}, scenario=demo,
                                    snapshot_folder=cls.folder, **parameters)
                         for node, parameters in NODES.items()]
        cls.simulation = Simulation({
            '/scene/agents': AgentStates, '/scene/forest/state': ForestState,
            '/scene/grass/state': GrassState, '/scene/canopy/state': CanopyState})
        for node in NODES:
            wait_for(lambda: listens('/scene/' + node, '/clock'), node)
        for node in ('forest_animator', 'canopy_animator'):
            wait_for(lambda: listens('/scene/' + node, '/scene/wind'), node)
        wait_for(lambda: listens('/scene/grass_field', '/scene/treads'), 'treads')
        wait_for(lambda: listens('/scene/agent_crowd', '/scene/grass/cover/resistance'), 'covers')
        cls.scene = Scene('/scene')
        cls.simulation.reset()
        # After the second step every node uses the published wind.
        wait_for(lambda: cls.simulation.step()['/scene/forest/state'].wind_hash != 0 and
                 len(cls.scene.nodes()) == len(NODES), 'the wind')
        cls.simulation.step(30)

    @classmethod
    def tearDownClass(cls):
        for process in cls.processes:
            stop(process)
        shutil.rmtree(cls.folder)

    def hashes(self, name):
        return {node: entry['hash'] for node, entry in self.scene.save(name)['nodes'].items()}

    def hold_a_branch(self):
        """A tree that nobody touches has no state but its level."""
        pose = rospy.ServiceProxy('/scene/forest_animator/get_tree', GetTree)(
            tree=0).transforms.poses[6].position
        target = PointStamped(point=Point(pose.x + 0.2, pose.y, pose.z))
        answer = rospy.ServiceProxy('/scene/forest_animator/grab', Grab)(
            tree=0, branch=6, target=target, has_lease=True, lease=600.0)
        self.assertTrue(answer.success, answer.message)

    def test_all_nodes_continue_with_the_same_hashes(self):
        Grass('/scene/grass_field').tread((-8, -3), (8, 2), radius=0.4, recovery=300)
        Crowd('/scene/agent_crowd').send([0, 1], (3, 3))
        self.hold_a_branch()
        self.simulation.step(SAVED)
        manifest = self.scene.save('kept')
        self.assertEqual(sorted(manifest['nodes']), ['/scene/' + node for node in sorted(NODES)])
        self.assertEqual(self.scene.manifest('kept'), manifest)
        saved = self.hashes('again')
        self.simulation.step(LATER)
        expected = self.hashes('later')
        self.assertFalse(set(expected.values()) & (set(saved.values()) - {
            saved['/scene/wind_broadcaster']}))
        replies = self.scene.load('kept', self.simulation)
        self.assertEqual({node: reply.hash for node, reply in replies.items()}, saved)
        self.assertEqual({reply.shift for reply in replies.values()}, {0.0})
        self.simulation.step(LATER)
        self.assertEqual(self.hashes('later_again'), expected)
        for node, entry in sorted(manifest['nodes'].items()):
            print('%s: %d bytes, saved in %.4f s, loaded in %.4f s' % (
                node, entry['bytes'], entry['seconds'], replies[node].seconds))

    # Treads and cover maps are on their way at some ticks.
    def test_the_nodes_continue_from_each_tick_of_a_period_of_cover_maps(self):
        for _ in range(16):
            self.simulation.step()
            self.scene.save('at_any_tick')
            self.simulation.step(20)
            expected = self.hashes('after')
            self.scene.load('at_any_tick', self.simulation)
            begin = time.monotonic()
            self.simulation.step(20)
            self.assertLess(time.monotonic() - begin, WAIT)
            self.assertEqual(self.hashes('after_again'), expected)

    def test_the_snippet_of_the_page_runs(self):
        with open(roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/snapshots.md') as page:
            block, = re.findall('^```python\n(.*?)^```', page.read(), re.S | re.M)
        block, alternatives = re.subn('^# (?=scene.load)', '', block, flags=re.M)
        self.assertEqual(alternatives, 1)
        exec(block, {'simulation': self.simulation})
        self.assertEqual(set(self.scene.manifest('before')['nodes']), set(self.scene.nodes()))

    def path_of(self, name, file):
        return os.path.join(self.folder, name, file)

    def alter(self, name, node, change):
        """Saves a scene, and changes the bytes of a file with a function."""
        path = self.path_of(name, self.scene.save(name)['nodes'][node]['file'])
        with open(path, 'rb') as file:
            content = file.read()
        with open(path, 'wb') as file:
            file.write(change(content))

    def seal(self, name):
        """Writes the sums of the present files into the manifest."""
        manifest = self.scene.manifest(name)
        for entry in manifest['nodes'].values():
            with open(self.path_of(name, entry['file']), 'rb') as file:
                entry['sha256'] = hashlib.sha256(file.read()).hexdigest()
        self.write_manifest(name, json.dumps(manifest))

    def write_manifest(self, name, text):
        with open(self.path_of(name, 'manifest.json'), 'w') as file:
            file.write(text)

    def test_one_bad_file_loads_nothing(self):
        self.alter('spoiled', '/scene/wind_broadcaster', lambda content: content + b'x')
        self.simulation.step(10)
        before = self.hashes('probe')
        with self.assertRaisesRegex(VegetationError, 'wind_broadcaster.snapshot: differs'):
            self.scene.load('spoiled')
        # The node finds it too, before the first one changes.
        self.seal('spoiled')
        with self.assertRaisesRegex(VegetationError, 'truncated or altered'):
            self.scene.load('spoiled')
        self.assertEqual(self.hashes('probe'), before)

    # A jump of the clock back would restart all nodes and remove their checkpoints.
    def test_a_file_of_another_version_leaves_the_clock_alone(self):
        def as_version_99(content):
            version = content.index(b'\n') + 1
            return content[:version] + struct.pack('<I', 99) + content[version + 4:]
        self.alter('other_version', '/scene/grass_field', as_version_99)
        self.seal('other_version')
        self.simulation.step(10)
        before, tick = self.hashes('probe'), self.simulation.tick
        with self.assertRaisesRegex(VegetationError, 'version = 99') as raised:
            self.scene.load('other_version', self.simulation)
        self.assertEqual(raised.exception.code, ErrorCode.FILE_REJECTED)
        self.assertEqual(self.simulation.tick, tick)
        self.assertEqual(self.hashes('probe'), before)

    def test_another_set_of_nodes_is_named(self):
        self.scene.save('whole')
        listed = os.path.join(self.folder, 'whole', 'manifest.json')
        with open(listed) as file:
            content = json.load(file)
        del content['nodes']['/scene/agent_crowd']
        with open(listed, 'w') as file:
            json.dump(content, file)
        with self.assertRaisesRegex(VegetationError, 'running are .*agent_crowd'):
            self.scene.load('whole')
        with self.assertRaisesRegex(VegetationError, 'no node below /empty/'):
            Scene('/empty').save('nothing')

    def test_services_save_and_load_at_the_present_time(self):
        save = rospy.ServiceProxy('/scene_snapshot/save', SaveSnapshot)
        load = rospy.ServiceProxy('/scene_snapshot/load', LoadSnapshot)
        saved = save(name='by_service')
        self.assertTrue(saved.success, saved.message)
        self.assertGreater(saved.bytes, 10000)
        self.simulation.step(45)
        loaded = load(name='by_service')
        self.assertTrue(loaded.success, loaded.message)
        self.assertAlmostEqual(loaded.shift, 1.5)
        self.simulation.step(5)

    def expect_refusal(self, code, text, service, **request):
        kind = SaveSnapshot if service == 'save' else LoadSnapshot
        answer = rospy.ServiceProxy('/scene_snapshot/' + service, kind)(**request)
        self.assertEqual((answer.success, answer.error_code), (False, code), answer.message)
        self.assertIn(text, answer.message)

    def test_refusals_of_the_services_have_codes(self):
        self.expect_refusal(ErrorCode.UNKNOWN, 'missing/manifest.json: there is no such file',
                            'load', name='missing')
        self.expect_refusal(ErrorCode.INVALID_VALUE, 'single node', 'load', name='a', node='b')
        self.scene.save('damaged')
        for text, what in [('{', 'cannot be read'), ('[]', 'format = None'),
                           ('{"format": 2}', 'format = 2'), ('{"format": 1}', 'nodes = None'),
                           ('{"format": 1, "nodes": {}}', 'nodes = {}'),
                           ('{"format": 1, "nodes": {"/a": {}}}', 'file of /a = None'),
                           ('{"format": 1, "nodes": {"/a": 3}}', 'file of /a = None')]:
            self.write_manifest('damaged', text)
            self.expect_refusal(ErrorCode.FILE_REJECTED, what, 'load', name='damaged')
        os.makedirs(self.path_of('blocked', 'manifest.json.part'))
        self.expect_refusal(ErrorCode.FILE_REJECTED, 'cannot be written', 'save', name='blocked')
        folder = rospy.get_param('/scene/wind_broadcaster/snapshot_folder')
        rospy.set_param('/scene/wind_broadcaster/snapshot_folder', 5)
        self.expect_refusal(ErrorCode.INTERNAL, 'TypeError', 'load', name='damaged')
        rospy.set_param('/scene/wind_broadcaster/snapshot_folder', folder)

    # The text is the same whether there is such a file or not.
    def test_names_do_not_leave_the_folder(self):
        outside = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, outside)
        with open(os.path.join(outside, 'manifest.json'), 'w') as file:
            file.write('{"format": 99}')
        for name in ('../' + os.path.basename(outside), '../none', '..', '', 'a/b', 'a' * 65):
            for service in ('load', 'save'):
                self.expect_refusal(ErrorCode.INVALID_VALUE, "name = '%s', allowed are" % name[:64],
                                    service, name=name)


if __name__ == '__main__':
    rospy.init_node('scene_test')
    rostest.rosrun('vegetation_sim', 'scene', SceneTest)
