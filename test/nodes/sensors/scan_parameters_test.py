#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""vegetation_scanner must reject bad parameters at startup and report all faults at once."""
import os
import tempfile

import rospy
import rostest

from refusing_node import Ranges, RefusingNode

# Each parameter with its unit, minimum and maximum.
NUMBERS = {
    'delay': (' s', 0, 5), 'elevation_low': (' rad', -1.5707, 1.5707),
    'elevation_high': (' rad', -1.5707, 1.5707), 'azimuth_low': (' rad', -6.2832, 6.2832),
    'azimuth_high': (' rad', -6.2832, 6.2832), 'range_min': (' m', 0, 100),
    'range_max': (' m', 0.1, 500), 'noise': (' m', 0, 1),
    'tolerance': (' m', 0.0001, 10), 'noise_proportional': ('', 0, 0.1), 'dropout': ('', 0, 1),
    'detection_range': (' m', 0, 1000), 'fog_visibility': (' m', 0, 100000),
    'rain_rate': (' mm/h', 0, 200), 'rain_returns': ('', 0, 10), 'divergence': (' rad', 0, 0.1),
    'return_separation': (' m', 0, 10), 'noise_weak': (' m', 0, 1), 'sky_range': (' m', 1, 500),
}
WHOLE_NUMBERS = {
    'rate': (' Hz', 1, 100), 'branch_budget': ('', 1000, 20000000), 'threads': ('', 1, 64), 'leaf_budget': ('', 1000, 3000000),
    'rings': ('', 1, 512), 'columns': ('', 1, 14400), 'samples': ('', 1, 37),
}
OTHERS = {'frame_id', 'lidar_frame', 'seed', 'preset', 'returns', 'motion', 'sky_frames'}


class ScanParameters(Ranges, RefusingNode):
    NODE = 'vegetation_scanner'
    NUMBERS, WHOLE_NUMBERS, OTHERS = NUMBERS, WHOLE_NUMBERS, OTHERS

    def test_inconsistent_parameters_are_rejected(self):
        refusal = self.refusal({'frame_id': '', 'lidar_frame': '/lidar', 'seed': -1})
        self.assertIn("~frame_id = '' is empty", refusal)
        self.assertIn("~lidar_frame = '/lidar' begins with '/'", refusal)
        self.assertIn('~seed', refusal)
        refusal = self.refusal({'elevation_low': 0.5, 'elevation_high': 0.2, 'azimuth_low': 1.0,
                                'azimuth_high': 1.0, 'range_min': 50.0, 'range_max': 20.0})
        for name in ('elevation_high', 'azimuth_high', 'range_max'):
            self.assertIn('~%s = ' % name, refusal)
        self.assertEqual(refusal.count('is not above'), 3)
        refusal = self.refusal({'azimuth_low': -4.0, 'azimuth_high': 4.0})
        self.assertIn('~azimuth_high is more than a turn', refusal)

    def test_unknown_words_and_numbers_of_samples_are_rejected(self):
        refusal = self.refusal({'returns': 'first', 'motion': 'smooth', 'samples': 5})
        self.assertIn("~returns = 'first' is none of strongest, last, both", refusal)
        self.assertIn("~motion = 'smooth' is none of none, deskewed, raw", refusal)
        self.assertIn('~samples = 5 is none of 1, 7, 19, 37', refusal)
        self.assertIn('~noise_weak = 0.100000 m needs a detection_range above 0 m',
                      self.refusal({'noise_weak': 0.1}))

    def test_bad_frames_of_the_sky_are_rejected(self):
        for frames, words in (
                ('antenna', 'sky_frames = antenna is not a list of frames'),
                (['antenna', 3], 'is not a list of frames'),
                (['/antenna'], "sky_frames has '/antenna', which is empty or begins with '/'"),
                (['antenna', 'antenna'], "sky_frames has 'antenna' twice"),
                (['a%d' % i for i in range(17)], 'sky_frames has 17 entries, allowed are 16')):
            self.assertIn(words, self.refusal({'sky_frames': frames}))

    def test_bad_presets_are_rejected(self):
        refusal = self.refusal({'preset': 'vlp17'})
        self.assertIn("~preset = 'vlp17' is none of os1_128, os1_64, utm30lx, vlp16, and no path",
                      refusal)
        self.assertIn('~preset = 16 is not text', self.refusal({'preset': 16}))
        self.assertIn('/none.yaml', self.refusal({'preset': '/none.yaml'}))
        with tempfile.TemporaryDirectory() as folder:
            own = os.path.join(folder, 'own.yaml')
            with open(own, 'w') as file:
                file.write('rings: 1000\nwavelength: 905\nreturns: best\n')
            refusal = self.refusal({'preset': own})
        for words in ('own.yaml: rings = 1000 is outside 1 to 512', 'wavelength',
                      "own.yaml: returns = 'best' is none of strongest, last, both"):
            self.assertIn(words, refusal)

    def test_parameters_replace_those_of_a_preset(self):
        refusal = self.refusal({'preset': 'vlp16', 'range_min': 100})
        self.assertIn('~range_max = 100.000000 is not above range_min = 100.000000', refusal)


if __name__ == '__main__':
    rospy.init_node('scan_parameters_test')
    rostest.rosrun('vegetation_sim', 'scan_parameters', ScanParameters)
