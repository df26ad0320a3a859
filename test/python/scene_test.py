#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Scene: all nodes of the demo continue from one snapshot with the same hashes."""
import hashlib
import json
import os
import re
import shutil
import tempfile
import unittest

import roslib.packages
import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped
from vegetation_sim import Crowd, Grass, Scene, Simulation, VegetationError
from vegetation_sim.msg import AgentStates, CanopyState, ForestState, GrassState
from vegetation_sim.srv import GetTree, Grab, LoadSnapshot, SaveSnapshot

from forest_rig import scene, start_node, stop
from waiting import wait_for
from watched_node import listens

# Treads and covers go from node to node at any time, so that runs differ. Here people leave no
# tracks and do not feel the grass.
NODES = {
    'wind_broadcaster': {}, 'forest_animator': {}, 'canopy_animator': {'frame_wait': 5.0},
    'grass_field': {},
    'agent_crowd': {'tread': 'none'},
}
REMAPPINGS = {'agent_crowd': {'grass/cover/resistance': 'no_cover'}}
SAVED, LATER = 90, 600


class SceneTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        demo = os.path.join(os.path.dirname(scene('forest')), 'demo.yaml')
        cls.processes = [start_node(node, '/scene/' + node, REMAPPINGS.get(node, {}),
                                    scenario=demo, snapshot_folder=cls.folder, **parameters)
                         for node, parameters in NODES.items()]
        cls.simulation = Simulation({
            '/scene/agents': AgentStates, '/scene/forest/state': ForestState,
            '/scene/grass/state': GrassState, '/scene/canopy/state': CanopyState})
        for node in NODES:
            wait_for(lambda: listens('/scene/' + node, '/clock'), node)
        for node in ('forest_animator', 'canopy_animator'):
            wait_for(lambda: listens('/scene/' + node, '/scene/wind'), node)
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

    def test_the_snippet_of_the_page_runs(self):
        with open(roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/snapshots.md') as page:
            block, = re.findall('^```python\n(.*?)^```', page.read(), re.S | re.M)
        block, alternatives = re.subn('^# (?=scene.load)', '', block, flags=re.M)
        self.assertEqual(alternatives, 1)
        exec(block, {'simulation': self.simulation})
        self.assertEqual(set(self.scene.manifest('before')['nodes']), set(self.scene.nodes()))

    def test_one_bad_file_loads_nothing(self):
        manifest = self.scene.save('spoiled')
        self.simulation.step(10)
        before = self.hashes('probe')
        path = os.path.join(self.folder, 'spoiled',
                            manifest['nodes']['/scene/wind_broadcaster']['file'])
        with open(path, 'ab') as file:
            file.write(b'x')
        with self.assertRaisesRegex(VegetationError, 'wind_broadcaster.snapshot: differs'):
            self.scene.load('spoiled')
        # The node finds it too, before the first one changes.
        listed = os.path.join(self.folder, 'spoiled', 'manifest.json')
        with open(listed) as file:
            content = json.load(file)
        for entry in content['nodes'].values():
            with open(os.path.join(self.folder, 'spoiled', entry['file']), 'rb') as file:
                entry['sha256'] = hashlib.sha256(file.read()).hexdigest()
        with open(listed, 'w') as file:
            json.dump(content, file)
        with self.assertRaisesRegex(VegetationError, 'truncated or altered'):
            self.scene.load('spoiled')
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
        self.assertIn('manifest.json', load(name='missing').message)
        self.assertIn("name = '..'", save(name='..').message)


if __name__ == '__main__':
    rospy.init_node('scene_test')
    rostest.rosrun('vegetation_sim', 'scene', SceneTest)
