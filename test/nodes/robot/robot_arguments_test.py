#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A wrong argument of robot.launch is refused with an error that names it, or the parameter which
follows from it, and the value. demo.launch gives it the frames and bodies of its robots."""
from xml.etree import ElementTree

import roslaunch.config
import roslaunch.xmlloader
import roslib.packages
import rospy
import rostest

from refusing_node import RefusingNode

LAUNCH_FILES = roslib.packages.get_pkg_dir('vegetation_sim') + '/launch/'


def load(file, arguments):
    """Returns what a launch file would start."""
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(LAUNCH_FILES + file, config, verbose=False,
                                         argv=['%s:=%s' % pair for pair in arguments.items()])
    return config


def parameters_of(node, arguments):
    """Returns the parameters of a node that robot.launch sets, as a tree."""
    return tree_of(node, load('robot.launch', arguments))


def tree_of(node, config):
    tree = {}
    for name, parameter in config.params.items():
        if name.startswith('/%s/' % node):
            *folders, last = name.split('/')[2:]
            branch = tree
            for folder in folders:
                branch = branch.setdefault(folder, {})
            branch[last] = parameter.value
    return tree


def frames_of(**arguments):
    """Returns the frames that tread the grass."""
    return [source['frame'] for source in parameters_of('grass_field', arguments)['sources']['robot']]


def corners_of(footprint):
    robot, = parameters_of('agent_crowd', {'footprint': footprint})['robots']['robot']
    return robot['outline']


class RobotArguments(RefusingNode):
    NODE = 'agent_crowd'

    def expect_refused(self, node, *words, **arguments):
        """Expects `words` in the error of a node that robot.launch starts with `arguments`."""
        self.NODE, self.executable = node, roslib.packages.find_node('vegetation_sim', node)[0]
        with self.subTest(node=node, **arguments):
            refusal = self.refusal(parameters_of(node, arguments))
            for word in words:
                self.assertIn(word, refusal)

    def test_frames_have_any_white_space_between_them(self):
        self.assertEqual(frames_of(wheel_frames=' left   right ', prefix='a/'), ['a/left', 'a/right'])
        self.assertEqual(frames_of(wheel_frames='  ', base_frame='base'), ['base'])

    def test_a_footprint_becomes_corners(self):
        self.assertEqual(corners_of('[[1, 2.5],[ -3, 4 ]]'), [{'x': 1, 'y': 2.5}, {'x': -3, 'y': 4}])
        self.assertEqual(corners_of('[ ]'), [])

    def test_a_footprint_that_is_no_list_of_corners(self):
        self.expect_refused('agent_crowd', 'outline', "x = 'foo' is not a number", footprint='foo')
        self.expect_refused('agent_crowd', 'outline', 'z', footprint='[[1, 2], [3, 4, 5], [6, 7]]')
        self.expect_refused('agent_crowd', 'outline[2]: y is missing',
                            footprint='[[1, 2], [3, 4], [6]]')

    def test_a_radius_out_of_range(self):
        for radius, text in (('-1', 'robot_radius = -1 m is outside 0.01 to 20 m'),
                             ('20.1', 'robot_radius = 20.1 m is outside 0.01 to 20 m'),
                             ('nan', 'robot_radius = nan m is outside 0.01 to 20 m'),
                             ('wide', "could not convert string to float: 'wide'")):
            with self.subTest(radius=radius):
                with self.assertRaises(roslaunch.xmlloader.XmlParseException) as caught:
                    parameters_of('agent_crowd', {'robot_radius': radius})
                self.assertIn(text, str(caught.exception))
        self.expect_refused('grass_field', 'sources', 'radius = 6 m is outside 0.005 to 5 m',
                            robot_radius='6')

    def test_keys_and_heights_of_sources(self):
        self.expect_refused('grass_field', 'sources', 'height_gate = -1 m is outside', height_gate='-1')
        self.expect_refused('grass_field', 'sources', 'radios is not a known key', tread='radios: 1')

    def test_cutters_are_those_of_three_nodes(self):
        for node in 'grass_field', 'canopy_animator', 'forest_animator':
            parameters = parameters_of(node, {'robot': 'a', 'cutters': '[{frame: bar, width: 2}]'})
            self.assertEqual(parameters['cutters'], {'a': [{'frame': 'bar', 'width': 2}]})
            self.assertNotIn('cutters', parameters_of(node, {}))
            self.expect_refused(node, 'cutters', 'height = 7 m is outside 0 to 5 m',
                                cutters='[{frame: bar, height: 7}]')

    def test_a_frame_that_begins_with_a_slash(self):
        for arguments in {'wheel_frames': 'left /right'}, {'prefix': '/', 'base_frame': 'right'}:
            self.expect_refused('grass_field', 'sources', "frame = '/right' begins with '/'",
                                **arguments)
        self.expect_refused('agent_crowd', 'robots', "frame = '/base' begins with '/'",
                            base_frame='/base')
        self.expect_refused('vegetation_scanner', "~lidar_frame = '/laser' begins with '/'",
                            lidar_frame='/laser')
        self.expect_refused('vegetation_camera', "~camera_frame = '/eye' begins with '/'",
                            camera_frame='/eye')
        for node in 'wind_broadcaster', 'agent_crowd':
            self.expect_refused(node, "frame_id = '/map' begins with '/'", world_frame='/map')

    def test_a_prefix_alone_names_no_frame(self):
        arguments = {'prefix': 'a/', 'lidar': 'true', 'camera': 'true'}
        self.assertEqual(parameters_of('vegetation_scanner', arguments)['lidar_frame'], '')
        self.assertEqual(parameters_of('vegetation_camera', arguments)['camera_frame'], '')

    def test_an_unknown_lidar_preset(self):
        self.expect_refused('vegetation_scanner', "~preset = 'vlp99' is none of", 'vlp16',
                            lidar_frame='laser', lidar_preset='vlp99')

    def test_an_unknown_scenario(self):
        for node in ('wind_broadcaster', 'forest_animator', 'grass_field', 'canopy_animator',
                     'agent_crowd'):
            self.expect_refused(node, '/config/scenarios/desert.yaml: cannot be read', scenario='desert')
            self.expect_refused(node, '/nowhere/my.yaml: cannot be read',
                                scenario_file='/nowhere/my.yaml')

    def test_a_description_that_is_no_parameter(self):
        for node in 'forest_animator', 'canopy_animator':
            self.expect_refused(node, "robot_description = 'nothing' is not a parameter",
                                robot_description='nothing')

    def test_the_robot_touches_branches_and_plants(self):
        for node in 'forest_animator', 'canopy_animator':
            parameters = parameters_of(node, {'robot': 'a', 'prefix': 'a/', 'robot_description': 'urdf'})
            self.assertEqual(parameters['bodies'], {'a': [{'robot_description': 'urdf', 'prefix': 'a/'}]})
            self.assertNotIn('bodies', parameters_of(node, {}))

    # N3: trees, plants, grass and people meet the robots of the demos, which have these frames.
    def test_the_robots_of_the_demos_are_connected(self):
        for scenario in 'crowd', 'demo', 'hills', 'meadow_robot', 'push', 'hedge', 'harvest':
            with self.subTest(scenario=scenario):
                self.check_demo(scenario, load('demo.launch', {'scenario': scenario, 'rviz': 'false'}))

    def check_demo(self, scenario, config):
        robot = ElementTree.fromstring(config.params['/robot_description'].value)
        self.assertTrue(robot.findall('link/collision'))
        frames = {link.get('name') for link in robot.findall('link')}
        for node in 'forest_animator', 'canopy_animator':
            self.assertEqual(tree_of(node, config).get('bodies'),
                             {'robot': [{'robot_description': 'robot_description', 'prefix': ''}]})
        sources = tree_of('grass_field', config)['sources']['robot']
        self.assertLessEqual({source['frame'] for source in sources}, frames)
        body, = tree_of('agent_crowd', config)['robots']['robot']
        self.assertIn(body['frame'], frames)
        cuts = scenario == 'harvest'
        for node in 'grass_field', 'canopy_animator', 'forest_animator':
            cutters = tree_of(node, config).get('cutters', {}).get('robot', [])
            self.assertEqual([cutter['frame'] in frames for cutter in cutters], [True] * cuts)
        truths = [node.remap_args for node in config.nodes if node.type == 'ground_truth_frame.py']
        drives = robot.get('name') == 'diff_drive'  # Its odometry drifts.
        self.assertEqual(truths, [[['ground_truth', 'base_pose_ground_truth']]] * drives)


if __name__ == '__main__':
    rospy.init_node('robot_arguments_test')
    rostest.rosrun('vegetation_sim', 'robot_arguments', RobotArguments)
