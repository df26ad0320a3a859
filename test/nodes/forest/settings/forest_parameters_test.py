#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""forest_animator must reject bad parameters and scenarios at startup and report all faults at
once."""
import roslib.packages
import rospy
import rostest

from refusing_node import Ranges, RefusingNode

# Each parameter with its unit, minimum and maximum.
NUMBERS = {
    'key_frame_period': (' s', 0.05, 60), 'markers_rate': (' Hz', 0.1, 60),
    'tf_rate': (' Hz', 0.1, 240), 'branches_rate': (' Hz', 0.1, 240),
    'viewer_field_of_view': (' rad', 0.01, 3.1), 'checkpoint_period': (' s', 0, 86400),
    'replay_delay': (' s', 0, 10),
    'tolerance': (' pixel', 0.01, 1000), 'transition': (' s', 0.01, 60),
    'size': ('', 0.2, 3), 'children': ('', 0.2, 3), 'leaves': ('', 0, 3), 'angle': ('', 0.2, 2),
    'noise': ('', 0, 3),
    'robot_tolerance': (' m', 0.0001, 10), 'robot_range': (' m', 0, 100),
    'frame_time': (' ms', 0.001, 1e6), 'tree_cost': (' ns', 0, 1e6),
    'procedural_cost': (' ns', 0.1, 10000),
    'modal_cost': (' ns', 0.1, 10000), 'fine_cost': (' ns', 0.1, 10000),
    'physical_cost': (' ns', 0.1, 1e6),
    'frame_wait': (' s', 0, 60), 'grab_lease': (' s', 0.1, 3600), 'grab_distance': (' m', 0.1, 1000),
}
WHOLE_NUMBERS = {
    'state_rate': (' Hz', 1, 240), 'marker_points': ('', 600, 3000000),
    'tf_budget': (' frames', 0, 10000), 'branches_budget': (' branches', 0, 1000000),
    'cache_budget': (' branches', 1000, 20000000), 'threads': ('', 1, 64),
    'viewer_height': (' pixel', 1, 100000),
    'fixed_level': ('', 0, 6), 'highest_level': ('', 0, 6),
    'state_bytes': (' B/s', 0, 100000000), 'modal_trees': ('', 0, 1000),
}
OTHERS = {'scenario', 'checkpoint', 'snapshot_folder',
          'frame_id', 'frame_prefix', 'viewer_frame', 'replay', 'branches_trees',
          'tf_promoted', 'cutters', 'shard', 'bodies'}  # robot_bodies_test has more tests of bodies

# Text of a bad scenario and the expected part of the error.
SCENARIOS = [
    ('{forests: 3}', 'forests is not a known key; known are frame_id, seed, terrain'),
    ('{forest: {trees: [{species: oak, x: 3}]}}', 'forest: trees[0]: x is not a known key'),
    ('{forest: {trees: 3}}', "forest: trees = '3' is not a list"),
    ('{forest: {species: [{name: palm}]}}', '/species/palm.yaml: cannot be read'),
    ('{forest: {species: [{file: SPECIES/oak.yaml}], trees: [{species: oak, scale: .nan}]}}',
     'forest: trees[0]: scale = nan is not finite, allowed is 0.05 to 20'),
    ('{forest: {species: [{file: SPECIES/oak.yaml}], trees: [{species: elm, yaw: 1e9}]}}',
     "forest: trees[0]: species = 'elm' is none of oak\n"),
    ('{forest: {species: [{file: SPECIES/oak.yaml}], tiles: [{count: -1, mix: {oak: 1}}]}}',
     'forest: tiles[0]: count = -1 is outside 0 to 1.67772e+07'),
    ('{forest: {motion: {transition: 0}, trees: []}}',
     'forest: motion: transition = 0 s is outside 0.01 to 60 s'),
    ('{forest: {motion: {gain: strong}}}', "gain = 'strong' is none of compliance, paper"),
    ('{terrain: nowhere.yaml, forest: {species: [{file: SPECIES/oak.yaml}]}}',
     '/nowhere.yaml: cannot be read: No such file or directory; in its folder are scene.yaml'),
    ('{terrain: "package://no_such_package/a.yaml"}', "package 'no_such_package' is not known"),
    ('{forest: {species: [{file: SPECIES/oak.yaml}], tiles: [{count: 4}]}}',
     'forest: layout: tiles[0]: mix has no positive weight'),
    ('{forest: {species: [{file: SPECIES/oak.yaml, stage: -1}]}}',
     'forest: species[0]: stage = -1 is outside 0 to 1'),
    ('{forest: {species: [{file: SPECIES/oak.yaml}], rows: [{species: oak, width: 5, rows: 2}]}}',
     'forest: rows[0]: rows and width are both given; only one is allowed'),
    ('{forest: {}}', 'forest: layout: species is empty'),
    ('{forest: {cutters: [{width: 0.2}]}}', 'forest: cutters[0]: frame is missing'),
    ('{seed: -1}', "seed = '-1' is not a whole number from 0 to 2^64 - 1"),
    ('{frame_id: /map}', "frame_id = '/map' begins with '/'"),
    ('{forest', 'not YAML'),
]


class ForestParameters(Ranges, RefusingNode):
    NODE = 'forest_animator'
    NUMBERS, WHOLE_NUMBERS, OTHERS = NUMBERS, WHOLE_NUMBERS, OTHERS

    def test_wrong_types_are_refused(self):
        wrong = dict(scenario=4, frame_id=True, viewer_frame=[1], replay='yes', branches_trees=3,
                     tf_promoted='no', shard=2, bodies=7)
        refusal = self.refusal(wrong)
        for text in ('~scenario = 4 is not text', '~frame_id = 1 is not text',
                     'viewer_frame = ', '~replay = yes is not true or false',
                     '~tf_promoted = no is not true or false',
                     '~shard = 2 is not a map',
                     '~branches_trees = 3 is not a list of whole numbers'):
            self.assertIn(text, refusal)
        self.assertIn('branches_trees = ', self.refusal({'branches_trees': [1, 'two']}))

    def test_frames_and_trees_that_cannot_be_are_refused(self):
        refusal = self.refusal({'frame_id': '', 'viewer_frame': '/camera', 'frame_prefix': '/a/'})
        self.assertIn("~frame_id = '' is empty", refusal)
        self.assertIn("~viewer_frame = '/camera' begins with '/'", refusal)
        self.assertIn("~frame_prefix = '/a/' begins with '/'", refusal)
        self.assertIn('~branches_trees = 3 is unknown; there are 0 trees, from 0',
                      self.refusal({'branches_trees': [3]}))

    def test_each_bad_scenario_is_refused_by_file_and_key(self):
        species = roslib.packages.get_pkg_dir('vegetation_sim') + '/config/species'
        for scenario, words in SCENARIOS:
            self.expect_scenario_refused(scenario.replace('SPECIES', species), words,
                                         by_file='frame_id' not in scenario)

    def test_bad_cutters_are_refused(self):
        for cutters, text in (
                ([{'frame': 'a', 'thickest': 0.6}],
                 'cutters[0]: thickest = 0.6 m is outside 0 to 0.5 m'),
                ([{'frame': 'a', 'thickest': -1}], 'thickest = -1 m is outside 0 to 0.5 m'),
                ([{'frame': 'a', 'thickest': float('nan')}], 'thickest = nan m is not finite'),
                ([{'frame': 'a', 'thickest': 'thumb'}], "thickest = 'thumb' is not a number"),
                ([{'frame': 'a', 'height': 6}], 'cutters[0]: height = 6 m is outside 0 to 5 m'),
                ([{'frame': 'a'}, {'frame': 'a'}], "cutters names 'a' twice"), (7, 'cutters = ')):
            self.assertIn(text, self.refusal({'cutters': cutters}))

    def test_a_shard_that_cannot_be_is_refused(self):
        for shard, text in (
                ({'count': 0}, 'shard: count = 0 is outside 1 to 256'),
                ({'count': 257}, 'shard: count = 257 is outside 1 to 256'),
                ({'index': -1}, 'shard: index = -1 is outside 0 to 255'),
                ({'index': 2, 'count': 2},
                 'shard: index = 2 is outside 0 to 1, because count = 2'),
                ({'number': 2}, 'number is not a known key; known are count, index, wait'),
                ({'wait': 0.01}, 'shard: wait = 0.01 s is outside 0.1 to 600 s')):
            self.assertIn(text, self.refusal({'shard': shard}))
        self.assertIn('~replay = true is not allowed with shard/count = 2, only with 1',
                      self.refusal({'shard': {'count': 2}, 'replay': True}))

    def test_faults_of_parameters_and_scenario_are_reported_together(self):
        refusal = self.refusal({'tolerance': 0, 'tf_rate': 'fast', 'lod': 3,
                                'scenario': '/nowhere/scene.yaml'})
        for text in ('~tolerance = 0 pixel', '~tf_rate = fast', '~lod is not a known parameter',
                     '/nowhere/scene.yaml: cannot be read'):
            self.assertIn(text, refusal)


if __name__ == '__main__':
    rospy.init_node('forest_parameters_test')
    rostest.rosrun('vegetation_sim', 'forest_parameters', ForestParameters)
