#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""agent_crowd must reject bad parameters and scenarios at startup and report all faults at once."""
import rospy
import rostest

from refusing_node import NAN, RefusingNode

# Each parameter with a bad value and the expected part of the error.
BAD = {
    'state_rate': (0, 'state_rate = 0 Hz is outside 1 to 240'),
    'markers_rate': (NAN, 'markers_rate = nan'),
    'marker_points': (3, 'marker_points = 3 is outside 3000 to 3e+06'),
    'tolerance': (0.0, 'tolerance = 0 pixel is outside 0.01 to 1000'),
    'tf_rate': (1e6, 'tf_rate = 1e+06 Hz is outside 0.1 to 240'),
    'tf_budget': (-1, 'tf_budget = -1 is outside 0 to 10000'),
    'frame_wait': (-1.0, 'frame_wait = -1 s is outside 0 to 60'),
    'cover_rate': (-1.0, 'cover_rate = -1 Hz is outside 0 to 60'),
    'tread': ('hands', 'tread'),
    'tread_ahead': (61, 'tread_ahead = 61 is outside 0 to 60'),
    'tread_radius': (-1.0, 'tread_radius = -1 m is outside 0 to 2'),
    'trunks': ('square', 'trunks'),
    'most_trunks': (-5, 'most_trunks = -5'),
    'most_walkers': (10 ** 9, 'most_walkers = 1e+09'),
    'threads': (0, 'threads = 0 is outside 1 to 64'),
    'view_range': (-1.0, 'view_range = -1 m is outside 0 to 100000'),
    'replay_delay': (-1.0, 'replay_delay = -1 s is outside 0 to 10'),
    'sensor_range': (0.0, 'sensor_range = 0 m is outside 0.5 to 20'),
    'neighbours': (99, 'neighbours = 99 is outside 1 to 8'),
    'behaviour': ('panic', 'behaviour'),
    'frame_id': ('/map', "frame_id"),
    'frame_prefix': ('/left/', "frame_prefix = '/left/' begins with '/'"),
    'robots': ([{'radius': 0.4}], 'needs a frame'),
    'motions': ([{'walk': 'package://vegetation_sim/config/terrain/hills.yaml'}],
                "expected HIERARCHY"),
    'speeed': (1.0, 'speeed'),
}
SCENARIOS = [
    ('{crowd: {walls: [{from: [0, 0, 0]}]}}', 'needs from and to'),
    ('{crowd: {walkers: [{x: .nan}]}}', 'x = nan'),
    ('{crowd: {groups: [{count: 1000000}]}}', 'count = 1e+06 is outside 1 to 100000'),
    ('{crowd: {robots: [{frame: /cart}]}}', "begins with '/'"),
    ('{crowd: {robots: [{frame: a}, {frame: a}]}}', 'twice'),
    ('{crowd: {motions: [{walk: /etc/passwd}]}}', 'is in no package and in no folder'),
    ('{crowd: {motions: [{run: a.bvh}]}}', 'run is not a known key'),
    ('{crowds: {}}', 'crowds is not a known key'),
]


class CrowdParameters(RefusingNode):
    NODE = 'agent_crowd'

    def test_all_faults_at_once(self):
        text = self.refusal({name: value for name, (value, _) in BAD.items()})
        for name, (_, words) in BAD.items():
            self.assertIn(words, text, name)

    def test_bad_scenarios(self):
        for scenario, words in SCENARIOS:
            self.expect_scenario_refused(scenario, words)

    def test_missing_file(self):
        self.assertIn('nowhere.yaml', self.refusal({'scenario': 'nowhere.yaml'}))


if __name__ == '__main__':
    rospy.init_node('crowd_parameters_test')
    rostest.rosrun('vegetation_sim', 'crowd_parameters_test', CrowdParameters)
