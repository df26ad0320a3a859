#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""canopy_animator refuses to start with bad parameters or a bad scenario, all faults at once."""
import os
import re
import subprocess
import tempfile
import unittest

import roslib.packages
import rospy
import rostest

NAN, INF = float('nan'), float('inf')

# parameter: unit, least, most
NUMBERS = {
    'markers_rate': (' Hz', 0.1, 60), 'replay_delay': (' s', 0, 10), 'turbulence': ('', 0, 1),
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
OTHERS = {'scenario', 'frame_id', 'viewer_id', 'viewer_frame', 'replay'}
BY_ROS = {'diagnostic_period'}  # diagnostic_updater's own

# What is wrong with a scenario: its text, what the refusal says.
SCENARIOS = [
    ('{canopies: 3}', 'canopies is not a known key'),
    ('{canopy: {fluids: {}}}', 'canopy: fluids is not a known key'),
    ('{canopy: {fluid: {cells: 48}}}', 'cells = 48 is no power of two'),
    ('{canopy: {fluid: {scheme: quick}}}', "scheme = 'quick' is none of reflection, fast, paper"),
    ('{canopy: {oscillator: {frequency: .nan}}}', 'frequency = nan Hz is not finite'),
    ('{canopy: {warp: {rigidity: 11}}}', 'rigidity = 11 is outside 0 to 10'),
    ('{canopy: {layers: {delay_speed: 0}}}', 'delay_speed = 0 m/s is outside'),
    ('{canopy: {kinds: [{name: a}, {name: a}]}}', "name = 'a' is there already"),
    ('{canopy: {plants: [{kind: b}]}}', "kind = 'b' is none of"),
    ('{canopy: {kinds: [{name: a, leaves: 1000000}], beds: [{kind: a, count: 3}]}}',
     '3000000 leaves, more than the 2000000 allowed'),
    ('{canopy: {cuts: {near_layers: 0, mid_layers: 0, far_layers: 0}}}', '= 0 is outside 1 to 16'),
    ('{terrain: nowhere.yaml, canopy: {}}', '/nowhere.yaml: cannot be read'),
    ('{canopy', 'not YAML'),
]


class CanopyParameters(unittest.TestCase):
    executable = roslib.packages.find_node('vegetation_sim', 'canopy_animator')[0]
    names = iter('started_%d' % i for i in range(1000))

    def refusal(self, parameters):
        """Starts a node, which must end with an error; returns what it wrote."""
        name = next(self.names)
        rospy.set_param('/' + name, parameters)
        done = subprocess.run([self.executable, '__name:=' + name], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1, parameters)
        self.assertIn('canopy_animator refuses to start', done.stderr)
        plain = re.sub(r'\x1b\[\d+m', '', done.stderr)  # without the colours of the log
        return plain.replace('-nan', 'nan').replace('/' + name + '/', '~')

    def expect_out_of_range(self, values):
        """All of them in one go, each by name, value and range."""
        refusal = self.refusal(values)
        for name, value in values.items():
            unit, least, most = {**NUMBERS, **WHOLE_NUMBERS}[name]
            self.assertIn('~%s = %g%s is outside %g to %g%s' % (name, value, unit, least, most,
                                                                unit), refusal)

    def test_values_below_the_range_are_refused(self):
        values = {name: least - 0.5 for name, (_, least, _) in NUMBERS.items()}
        values.update({name: least - 1 for name, (_, least, _) in WHOLE_NUMBERS.items()})
        self.expect_out_of_range(values)

    def test_values_above_the_range_are_refused(self):
        values = {name: 2.0 * most for name, (_, _, most) in NUMBERS.items()}
        values.update({name: most + 1 for name, (_, _, most) in WHOLE_NUMBERS.items()})
        self.expect_out_of_range(values)

    def test_what_is_not_finite_is_refused(self):
        for value, text in ((NAN, 'nan'), (INF, 'inf'), (-INF, '-inf')):
            refusal = self.refusal({name: value for name in NUMBERS})
            for name, (unit, least, most) in NUMBERS.items():
                self.assertIn('~%s = %s%s is not finite, allowed is %g to %g%s' % (
                    name, text, unit, least, most, unit), refusal)

    # Every parameter that there is has been given a wrong value somewhere here.
    def test_unknown_parameters_are_refused_and_the_known_ones_are_these(self):
        refusal = self.refusal({'tolerence': 2.0})
        self.assertIn('~tolerence is not a known parameter; known are ', refusal)
        known = set(re.search('known are (.*)', refusal).group(1).split(', '))
        self.assertEqual(known - BY_ROS, OTHERS | set(NUMBERS) | set(WHOLE_NUMBERS))

    def test_what_does_not_fit_together_is_refused(self):
        refusal = self.refusal({'frame_id': '', 'viewer_frame': '/camera', 'replay': 'yes'})
        self.assertIn("~frame_id = '' is empty", refusal)
        self.assertIn("~viewer_frame = '/camera' begins with '/'", refusal)
        self.assertIn('~replay = yes is not true or false', refusal)
        none = {'near_layers': 0, 'mid_layers': 0, 'far_layers': 0}
        self.assertIn('= 0 is outside 1 to 16', self.refusal(none))

    def test_each_bad_scenario_is_refused_by_file_and_key(self):
        for scenario, text in SCENARIOS:
            with self.subTest(text=text), tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, 'scene.yaml')
                with open(name, 'w') as file:
                    file.write(scenario)
                refusal = self.refusal({'scenario': name})
                self.assertIn(text, refusal)
                self.assertIn(folder, refusal)


if __name__ == '__main__':
    rospy.init_node('canopy_parameters_test')
    rostest.rosrun('vegetation_sim', 'canopy_parameters', CanopyParameters)
