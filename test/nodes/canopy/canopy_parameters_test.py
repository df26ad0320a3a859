#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""canopy_animator must reject bad parameters and scenarios at startup and report all faults at
once."""
import rospy
import rostest

from refusing_node import Ranges, RefusingNode

# Each parameter with its unit, minimum and maximum.
NUMBERS = {
    'markers_rate': (' Hz', 0.1, 60), 'tolerance': (' pixel', 0.01, 1000),
    'frame_wait': (' s', 0, 60), 'cover_resolution': (' m', 0.02, 100),
    'checkpoint_period': (' s', 0, 86400),
    'replay_delay': (' s', 0, 10), 'turbulence': ('', 0, 1),
    'law_gain': ('', 0, 10), 'frequency': (' Hz', 0.05, 20), 'damping': ('', 0, 50),
    'speed': (' m/s', 0, 20), 'reference_time': (' s', 0, 1), 'rigidity': ('', 0, 10),
    'delay_speed': (' m/s', 0.01, 100), 'depth_loss': ('', 0, 1),
    'rightward': (' m/s', 0, 50), 'leftward': (' m/s', 0, 50), 'upward': (' m/s', 0, 50),
    'downward': (' m/s', 0, 50), 'rightward_frequency': (' Hz', 0, 100),
    'leftward_frequency': (' Hz', 0, 100), 'upward_frequency': (' Hz', 0, 100),
    'downward_frequency': (' Hz', 0, 100),
}
WHOLE_NUMBERS = {
    'marker_points': ('', 600, 3000000), 'near_layers': ('', 0, 16), 'mid_layers': ('', 0, 16),
    'far_layers': ('', 0, 16),
}
OTHERS = {'scenario', 'checkpoint', 'snapshot_folder',
          'frame_id', 'viewer_id', 'viewer_frame', 'replay', 'walkers',
          'bodies', 'cutters'}  # robot_bodies_test has more tests of bodies

# Text of a bad scenario and the expected part of the error.
SCENARIOS = [
    ('{canopies: 3}', 'canopies is not a known key'),
    ('{canopy: {fluids: {}}}', 'canopy: fluids is not a known key'),
    ('{canopy: {fluid: {cells: 48}}}', 'cells = 48 is no power of two'),
    ('{canopy: {fluid: {scheme: quick}}}', "scheme = 'quick' is none of reflection, fast, paper"),
    ('{canopy: {oscillator: {frequency: .nan}}}', 'frequency = nan Hz is not finite'),
    ('{canopy: {warp: {rigidity: 11}}}', 'rigidity = 11 is outside 0 to 10'),
    ('{canopy: {layers: {delay_speed: 0}}}', 'delay_speed = 0 m/s is outside'),
    ('{canopy: {kinds: [{name: a}, {name: a}]}}', "name = 'a' is defined twice"),
    ('{canopy: {plants: [{kind: b}]}}', "kind = 'b' is none of"),
    ('{canopy: {kinds: [{name: a, leaves: 1000000}], beds: [{kind: a, count: 4}]}}',
     '4000000 leaves, more than the 3000000 allowed'),
    ('{canopy: {kinds: [{name: a, shape: mesh}]}}', "file = ''; shapes mesh and slices have one"),
    ('{canopy: {kinds: [{name: a, file: b.obj}]}}', "file = 'b.obj'; shapes mesh and slices"),
    ('{canopy: {kinds: [{name: a, shape: mesh, file: nothing.obj}]}}',
     'nothing.obj: cannot be read'),
    ('{canopy: {kinds: [{name: a}], crowns: [{kind: a, trees: 0}]}}', 'trees = 0 is outside 1'),
    ('{canopy: {kinds: [{name: a, push_stiffness: -1}]}}', 'push_stiffness = -1 N/m^3 is outside'),
    ('{canopy: {cuts: {near_layers: 0, mid_layers: 0, far_layers: 0}}}', '= 0 is outside 1 to 16'),
    ('{canopy: {kinds: [{name: a, stage: 2}]}}', 'stage = 2 is outside 0 to 1'),
    ('{canopy: {kinds: [{name: a, slope: 1}]}}', 'slope is not a known key'),
    ('{canopy: {kinds: [{name: a, shape: trellis, slope: 3}]}}', 'slope = 3 is outside -2 to 2'),
    ('{canopy: {kinds: [{name: a}], rows: [{kind: a, plant_spacing: 0}]}}',
     'rows[0]: plant_spacing = 0 m is outside 0.01 to 1000 m'),
    ('{canopy: {cutters: [{width: 0.2}]}}', 'cutters[0]: frame is missing'),
    ('{terrain: nowhere.yaml, canopy: {}}', '/nowhere.yaml: cannot be read'),
    ('{canopy', 'not YAML'),
]


class CanopyParameters(Ranges, RefusingNode):
    NODE = 'canopy_animator'
    NUMBERS, WHOLE_NUMBERS, OTHERS = NUMBERS, WHOLE_NUMBERS, OTHERS

    def test_inconsistent_parameters_are_rejected(self):
        refusal = self.refusal({'frame_id': '', 'viewer_frame': '/camera', 'replay': 'yes'})
        self.assertIn("~frame_id = '' is empty", refusal)
        self.assertIn("~viewer_frame = '/camera' begins with '/'", refusal)
        self.assertIn('~replay = yes is not true or false', refusal)
        self.assertIn('~walkers = some is not true or false', self.refusal({'walkers': 'some'}))
        bodies = self.refusal({'bodies': [{'frame': 'arm', 'shape': 'sphere', 'radius': 0}]})
        self.assertIn('radius = 0 m is outside 0.001 to 50', bodies)
        person = {'id': 'walker_3', 'frame': 'arm', 'shape': 'sphere', 'radius': 1}
        self.assertIn('~bodies: id = walker_3 begins with walker_', self.refusal({'bodies': [person]}))
        none = {'near_layers': 0, 'mid_layers': 0, 'far_layers': 0}
        self.assertIn('= 0 is outside 1 to 16', self.refusal(none))

    def test_bad_cutters_are_rejected(self):
        for cutters, text in (
                ([{'frame': 'a', 'height': 6}], 'cutters[0]: height = 6 m is outside 0 to 5 m'),
                ([{'frame': 'a', 'shape': 'saw'}], "cutters[0]: shape = 'saw' is none of box, disc"),
                ([{'frame': 'a'}, {'frame': 'a'}], "cutters names 'a' twice")):
            self.assertIn(text, self.refusal({'cutters': cutters}))

    def test_each_bad_scenario_is_refused_by_file_and_key(self):
        for scenario, words in SCENARIOS:
            self.expect_scenario_refused(scenario, words)


if __name__ == '__main__':
    rospy.init_node('canopy_parameters_test')
    rostest.rosrun('vegetation_sim', 'canopy_parameters', CanopyParameters)
