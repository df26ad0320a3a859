#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The XML, YAML and Python of README.md, docs and the tutorials is given to what reads it:
roslaunch, nodes, and the Python clients. recipes_test.py runs snippets with messages of others."""
import glob
import os
import re
import tempfile
import unittest
from xml.etree import ElementTree

import roslaunch.config
import roslaunch.xmlloader
import rospy
import rostest
import yaml
from PIL import Image

from launch_arguments import declared, unknown_in_includes
from pages import PACKAGE, PAGES, SHELL, blocks, fenced, text
from running import publish_frame, start_node
from waiting import wait_for

# The test of the blocks of each page and language.
TESTS = {
    ('README.md', 'xml'): 'blocks_test',
    ('docs/grab.md', 'yaml'): 'blocks_test',
    ('docs/grab.md', 'python'): 'blocks_test',
    ('docs/grass.md', 'yaml'): 'blocks_test',
    ('docs/lockstep.md', 'python'): 'simulation_test',
    ('docs/python.md', 'python'): 'python_clients_test',
    ('docs/snapshots.md', 'python'): 'scene_test',
    ('docs/tutorials/1_first_scene.md', 'yaml'): 'snippets_test',
    ('docs/tutorials/2_your_robot.md', 'xml'): 'blocks_test',
    ('docs/tutorials/3_planner.md', 'python'): 'recipes_test',
    ('docs/tutorials/3_planner.md', 'yaml'): 'blocks_test',
    ('docs/tutorials/4_arm.md', 'python'): 'blocks_test',
    ('docs/wind.md', 'yaml'): 'blocks_test',
}


def included(block):
    return block if '<launch>' in block else '<launch>%s</launch>' % block


class Blocks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frame = publish_frame('gripper', -0.6, -0.8, 2.8)

    def test_every_block_has_a_test(self):
        found = {(page, language) for page in PAGES for language, _ in blocks(text(page))
                 if language not in SHELL}
        self.assertEqual(found, set(TESTS))

    def test_xml_is_loaded_and_passes_only_declared_arguments(self):
        for page in PAGES:
            for block in fenced(page, 'xml'):
                with self.subTest(page=page, block=block), \
                        tempfile.NamedTemporaryFile('w', suffix='.launch') as file:
                    file.write(included(block))
                    file.flush()
                    config = roslaunch.config.ROSLaunchConfig()
                    roslaunch.xmlloader.XmlLoader().load(file.name, config, argv=[], verbose=False)
                    self.assertTrue(config.nodes or config.params)
                    root = ElementTree.fromstring(included(block))
                    self.assertEqual(unknown_in_includes(root), [])

    def test_launch_files_of_the_package_pass_only_declared_arguments(self):
        files = [file for folder in ('launch', 'test', 'examples') for kind in ('launch', 'test')
                 for file in glob.glob('%s/%s/**/*.%s' % (PACKAGE, folder, kind), recursive=True)]
        self.assertGreater(len(files), 20)
        for file in files:
            self.assertEqual(unknown_in_includes(ElementTree.parse(file).getroot()), [], file)

    def test_an_unknown_argument_of_an_include_is_found(self):
        file = '$(find vegetation_sim)/launch/robot.launch'
        # robot.launch computes its argument `source`, so it cannot be passed.
        block = '<launch><group><include file="%s"><arg name="bogus" value="1"/><arg name="robot" ' \
                'value="a"/><arg name="source" value=""/></include></group></launch>' % file
        self.assertEqual(unknown_in_includes(ElementTree.fromstring(block)),
                         [(file, ['bogus', 'source'])])
        self.assertIn('robot', declared(PACKAGE + '/launch/robot.launch'))

    def test_grass_field_reads_the_meadow_and_the_sources(self):
        meadow, cutters, sources = map(yaml.safe_load, fenced('docs/grass.md', 'yaml'))
        sources.update(cutters)
        with tempfile.TemporaryDirectory() as folder:
            Image.new('L', (51, 51), 128).save(folder + '/density.png')

            def start(grass, **parameters):
                with open(folder + '/scene.yaml', 'w') as file:
                    yaml.safe_dump({'frame_id': 'map', 'grass': grass}, file)
                start_node('grass_field', ['_scenario:=%s/scene.yaml' % folder], **parameters)
            start({**meadow, **sources})
            start(meadow, **sources)
            with self.assertRaisesRegex(AssertionError, 'bogus'):
                start({**meadow, 'bogus': 1})

    def test_wind_broadcaster_reads_the_air_of_vehicles(self):
        found = fenced('docs/wind.md', 'yaml')
        self.assertEqual(len(found), 2)

        def start(scene):
            with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
                file.write(scene)
                file.flush()
                start_node('wind_broadcaster', ['_scenario:=' + file.name])
        for block in found:
            start(block)
            with self.assertRaisesRegex(AssertionError, 'bogus'):
                start(block.replace('attached_frame', 'bogus'))

    def test_forest_animator_reads_the_bodies(self):
        block, = fenced('docs/grab.md', 'yaml')
        with open(PACKAGE + '/test/nodes/rigs/robot.urdf') as urdf:
            rospy.set_param('/snippets/robot_description', urdf.read())
        scene = '_scenario:=%s/config/scenarios/grab.yaml' % PACKAGE
        start_node('forest_animator', [scene], **yaml.safe_load(block))
        faulty = yaml.safe_load(block.replace('capsule', 'cone'))
        with self.assertRaisesRegex(AssertionError, 'cone'):
            start_node('forest_animator', [scene], **faulty)

    def test_the_topic_of_the_costmap_is_a_map(self):
        block, = map(yaml.safe_load, fenced('docs/tutorials/3_planner.md', 'yaml'))
        for plugin in block['plugins']:
            topic = block[plugin['name']]['map_topic']
            self.assertEqual(wait_for(lambda: dict(rospy.get_published_topics()).get(topic), topic),
                             'nav_msgs/OccupancyGrid')

    def test_python_of_grabs_runs(self):
        for page in ('docs/grab.md', 'docs/tutorials/4_arm.md'):
            for block in fenced(page, 'python'):
                with self.subTest(page=page, block=block):
                    code = re.sub(r'^rospy.init_node.*$', '', block, flags=re.M)
                    exec(compile(code, os.path.basename(page), 'exec'), {})


if __name__ == '__main__':
    rospy.init_node('blocks_test')
    rostest.rosrun('vegetation_sim', 'blocks', Blocks)
