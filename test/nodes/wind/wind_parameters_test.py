#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""wind_broadcaster must reject bad parameters at startup and report all faults at once."""
import signal
import subprocess

import rospy
import rostest
from vegetation_sim.srv import GetWindField

from refusing_node import INF, NAN, RefusingNode
from waiting import wait_for

# Each parameter with a bad value and the expected part of the error.
CASES = [
    ('lead', 'soon', 'lead = soon is not a number'),
    ('lead', -0.1, 'lead = -0.1 s is outside 0 to 10 s'),
    ('lead', 10.5, 'lead = 10.5 s is outside 0 to 10 s'),
    ('lead', NAN, 'lead = nan s is not finite'),
    ('lead', INF, 'lead = inf s is not finite'),
    ('attach_rate', 11.0, 'attach_rate = 11 Hz is outside 0.5 to 10 Hz'),
    ('attach_rate', [5.0], 'attach_rate = '),
    ('attach_horizon', 0.1, 'attach_horizon = 0.1 s is outside 0.5 to 30 s'),
    ('attach_horizon', 0.6, 'is less than 4 lead and 4 / attach_rate = 0.8'),
    ('markers_rate', 0, 'markers_rate = 0 Hz is outside 0.1 to 60 Hz'),
    ('markers_rate', True, 'is not a number'),
    ('seed', -3, 'seed = -3 is not a whole number from 0 to 2^64 - 1'),
    ('seed', 'seven', 'seed = seven is not a whole number'),
    ('frame_id', 7, 'frame_id = 7 is not text'),
    ('frame_id', '', "frame_id = '' is empty"),
    ('frame_id', '/map', "frame_id = '/map' begins with '/'"),
    ('breeze_speed', 201.0, 'breeze_speed = 201 m/s is outside 0 to 200 m/s'),
    ('breeze_speed', NAN, 'breeze_speed = nan m/s is not finite'),
    ('breeze_direction', 4.0, 'breeze_direction = 4 rad is outside'),
    ('breeze_turbulence', 1.5, 'breeze_turbulence = 1.5 is outside 0 to 1'),
    ('sample_rate', 0.0, 'sample_rate = 0 Hz is outside 0.1 to 240 Hz'),
    ('sample_frames', 'mast', 'sample_frames = mast is not a list of frames'),
    ('sample_frames', ['mast', 3], 'is not a list of frames'),
    ('sample_frames', ['/mast'], "sample_frames has '/mast', which is empty or begins with '/'"),
    ('sample_frames', ['mast', 'mast'], "sample_frames has 'mast' twice"),
    ('sample_frames', ['m%d' % i for i in range(257)], 'has 257 entries, allowed are 256'),
    ('scenario', 3, 'scenario = 3 is not text'),
    ('scenario', '/nowhere/scene.yaml', '/nowhere/scene.yaml: cannot be read'),
    ('scenario', 'package://vegetation_simm/scene.yaml', 'vegetation_simm'),
    ('sceanrio', 'x.yaml', 'sceanrio is not a known parameter; known are'),
]

# A bad scenario and the expected part of the error.
SCENARIOS = [
    ('{winds: 3}', 'winds is not a known key'),
    ('{wind: {primitives: [{name: a, kind: disk, radius: .nan}]}}',
     'wind: primitives[0]: radius = nan m is not finite'),
    ('{wind: {primitives: [{name: a, kind: disk, colour: red}]}}', 'colour is not a known key'),
    ('{wind: {seed: many}}', "seed = 'many' is not a whole number"),
    ('{wind: [1]}', 'a list is not a map of keys'),
    ('{wind', 'not YAML'),
]


class WindParameters(RefusingNode):
    NODE = 'wind_broadcaster'

    def test_each_bad_parameter_is_rejected_with_its_name(self):
        for name, value, text in CASES:
            with self.subTest(name=name, value=value):
                self.assertIn(text, self.refusal({name: value}))

    def test_each_bad_scenario_is_refused_by_file_and_key(self):
        for scenario, words in SCENARIOS:
            self.expect_scenario_refused(scenario, words)

    def test_all_faults_are_reported_at_once(self):
        refusal = self.refusal({'lead': 99.0, 'markers_rate': 'often', 'sede': 3,
                                'scenario': '/nowhere/scene.yaml'})
        for text in ['lead = 99 s', 'markers_rate = often', 'sede is not a known parameter',
                     '/nowhere/scene.yaml']:
            self.assertIn(text, refusal)

    def test_good_parameters_are_taken(self):
        name = next(self.names)
        rospy.set_param('/' + name, {'lead': 1, 'attach_horizon': 8, 'frame_id': 'odom',
                                     'seed': '18446744073709551615', 'breeze_speed': 3.0})
        node = subprocess.Popen([self.executable, '__name:=' + name])
        try:
            field = wait_for(lambda: self.field_of(name), 'the node').field
        finally:
            node.send_signal(signal.SIGINT)
            self.assertEqual(node.wait(), 0)
        self.assertEqual(field.header.frame_id, 'odom')
        self.assertEqual(field.seed, 2 ** 64 - 1)
        self.assertEqual([p.name for p in field.primitives], ['breeze'])
        self.assertEqual(field.primitives[0].velocity.x, 3.0)

    @staticmethod
    def field_of(name):
        try:
            answer = rospy.ServiceProxy('/%s/get_field' % name, GetWindField)()
            return answer if answer.success else None
        except rospy.ServiceException:
            return None


if __name__ == '__main__':
    rospy.init_node('wind_parameters_test')
    rostest.rosrun('vegetation_sim', 'wind_parameters', WindParameters)
