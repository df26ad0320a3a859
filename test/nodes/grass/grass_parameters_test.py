#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""grass_field must reject bad parameters and scenarios at startup and report all faults at once."""
import rospy
import rostest

from refusing_node import Ranges, RefusingNode

# Each parameter with its unit, minimum and maximum.
NUMBERS = {
    'key_frame_period': (' s', 0.05, 60), 'markers_rate': (' Hz', 0.1, 60),
    'cover_rate': (' Hz', 0.1, 60), 'cover_resolution': (' m', 0.02, 100),
    'cover_density': (' 1/m^2', 1, 20000), 'cover_resistance': (' N s/m', 0.001, 1e8),
    'cover_age': (' s', 1, 1e9), 'view_range': (' m', 0, 100000), 'viewer_field_of_view': (' rad', 0.01, 3.1),
    'checkpoint_period': (' s', 0, 86400), 'frame_wait': (' s', 0, 60),
    'replay_delay': (' s', 0, 10), 'drag': (' N s/m', 0, 1000), 'height_gate': (' m', 0, 1000),
    'tread_radius': (' m', 0.005, 5), 'tread_reach': (' m', 0.01, 10),
    'tread_softness': (' m', 0.001, 5), 'tread_load': ('', 0, 10), 'tread_recovery': (' s', 0, 1e9),
    'tolerance': (' pixel', 0.1, 100), 'transition': (' s', 0, 60), 'farthest': (' m', 1, 1e4),
}
WHOLE_NUMBERS = {
    'state_rate': (' Hz', 1, 240), 'state_bytes': (' B/s', 1000, 1000000000),
    'marker_points': ('', 900, 3000000), 'viewer_height': (' pixel', 1, 100000),
}
OTHERS = {'scenario', 'checkpoint', 'snapshot_folder',
          'frame_id', 'viewer_frame', 'replay', 'cover_layer', 'sources', 'cutters', 'shard'}

# Text of a bad scenario and the expected part of the error.
SCENARIOS = [
    ('{grasses: 3}', 'grasses is not a known key; known are frame_id, seed, terrain'),
    ('{grass: {densty: 3}}', 'grass: densty is not a known key'),
    ('{grass: {density: {value: -5}}}', 'density: value = -5 1/m^2 is outside 0 to '),
    ('{grass: {density: {value: .nan}}}', 'density: value = nan'),
    ('{grass: {density: {image: colour.png}}}', 'colour.png'),
    ('{grass: {density: {image: nowhere.png}}}', '/nowhere.png'),
    ('{grass: {resolution: 50, density: {value: 10000}}}', 'blades in a tile, allowed are fewer'),
    ('{grass: {species: [{name: a, stage: 1.5}]}}', 'stage = 1.5 is outside 0 to 1'),
    ('{grass: {species: [{name: a}, {name: a}]}}', "species 'a' is defined twice"),
    ('{grass: {map: nowhere.yaml}}', '/nowhere.yaml: cannot be read'),
    ('{grass: {blade_model: rubber}}', "blade_model = 'rubber' is none of arc, paper"),
    ('{grass: {tread: {radius: 0.3, reach: 0.3}}}', 'reach = 0.3'),
    ('{grass: {treading: {spacing: 0}}}', 'treading: spacing = 0 m is outside 0.01 to 10 m'),
    ('{terrain: nowhere.yaml, grass: {}}', '/nowhere.yaml: cannot be read'),
    ('{grass', 'not YAML'),
]
# A bad list of sources and the expected part of the error.
SOURCES = [
    ([{'radius': 0.2}], 'needs either frame or odometry'),
    ([{'frame': 'a', 'odometry': 'b'}], 'needs either frame or odometry'),
    ([{'frame': '/wheel'}], "frame = '/wheel' begins with '/'"),
    ([{'frame': 'a', 'radios': 3}], 'sources[0]: radios is not a known key'),
    ([{'frame': 'a', 'radius': -1.0}], 'sources[0]: radius = -1 m is outside 0.005 to 5 m'),
    ([{'frame': 'a', 'height_gate': -1.0}], 'height_gate = -1 m is outside 0 to 1000 m'),
    ([{'frame': 'a', 'offset': [1.0, 2.0]}], 'offset'),
    ([{'frame': 'a'}, {'frame': 'a'}], "sources names 'a' twice"),
    ([{'frame': 'a', 'radius': 0.3, 'reach': 0.2}], 'reach = 0.2'),
    (7, "sources = '7' is not a list"),
]
# The same for cutting tools.
CUTTERS = [
    ([{'width': 0.2}], "cutters[0]: frame is missing"),
    ([{'frame': '/deck'}], "frame = '/deck' begins with '/'"),
    ([{'frame': 'a', 'widht': 3}], 'cutters[0]: widht is not a known key'),
    ([{'frame': 'a', 'width': 0.0}], 'cutters[0]: width = 0 m is outside 0.01 to 20 m'),
    ([{'frame': 'a', 'height': -1.0}], 'height = -1 m is outside 0 to 5 m'),
    ([{'frame': 'a', 'swath_width': 21.0}], 'swath_width = 21 m is outside 0 to 20 m'),
    ([{'frame': 'a', 'shape': 'star'}], "shape = 'star' is none of box, disc"),
    ([{'frame': 'a'}, {'frame': 'a'}], "cutters names 'a' twice"),
    (7, "cutters = '7' is not a list"),
]


class GrassParameters(Ranges, RefusingNode):
    NODE = 'grass_field'
    NUMBERS, WHOLE_NUMBERS, OTHERS = NUMBERS, WHOLE_NUMBERS, OTHERS

    def test_wrong_types_are_refused(self):
        wrong = dict(scenario=4, frame_id=True, viewer_frame=[1], replay='yes', cover_layer='red',
                     shard=2)
        refusal = self.refusal(wrong)
        for text in ('~scenario = 4 is not text', '~frame_id = 1 is not text', 'viewer_frame = ',
                     '~replay = yes is not true or false', '~shard = 2 is not a map',
                     "~cover_layer = 'red' is none of crush, density, resistance, age"):
            self.assertIn(text, refusal)

    def test_inconsistent_parameters_are_rejected(self):
        refusal = self.refusal({'frame_id': '', 'viewer_frame': '/camera'})
        self.assertIn("~frame_id = '' is empty", refusal)
        self.assertIn("~viewer_frame = '/camera' begins with '/'", refusal)
        self.assertIn('reach = 0.3', self.refusal({'tread_radius': 0.3, 'tread_reach': 0.3}))
        self.assertIn('cells, allowed are', self.refusal({'cover_resolution': 0.02}))
        self.assertIn('shard: index = 2 is outside 0 to 1, because count = 2',
                      self.refusal({'shard': {'index': 2, 'count': 2}}))

    def test_each_bad_source_or_cutter_is_refused(self):
        for cutters, text in CUTTERS:
            with self.subTest(text=text):
                self.assertIn(text, self.refusal({'cutters': cutters}))
        for sources, text in SOURCES:
            with self.subTest(text=text):
                self.assertIn(text, self.refusal({'sources': sources}))

    def test_each_bad_scenario_is_refused_by_file_and_key(self):
        for scenario, words in SCENARIOS:
            self.expect_scenario_refused(scenario, words, [('colour.png', COLOUR_PICTURE)])


# The image has one red pixel and is not greyscale.
COLOUR_PICTURE = bytes.fromhex(
    '89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63'
    'f8cfc0000003010100c9fe92ef0000000049454e44ae426082')


if __name__ == '__main__':
    rospy.init_node('grass_parameters_test')
    rostest.rosrun('vegetation_sim', 'grass_parameters', GrassParameters)
