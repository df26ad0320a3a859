#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""vegetation_camera must reject bad parameters and calibrations at startup."""
import os
import tempfile

import rospy
import rostest

from refusing_node import Ranges, RefusingNode

# Each parameter with its unit, minimum and maximum.
NUMBERS = {
    'delay': (' s', 0, 5), 'tolerance': (' m', 0.0001, 10), 'field_of_view': (' rad', 0.01, 2.8),
    'k1': ('', -10, 10), 'k2': ('', -10, 10), 'p1': ('', -1, 1), 'p2': ('', -1, 1),
    'k3': ('', -10, 10), 'range_min': (' m', 0, 100), 'range_max': (' m', 0.1, 500),
    'sun_azimuth': (' rad', -6.2832, 6.2832), 'sun_elevation': (' rad', 0, 1.5707),
    'fog_visibility': (' m', 0, 100000), 'exposure': ('', 0.001, 1000), 'read_noise': ('', 0, 1),
    'shot_noise': ('', 0, 1),
}
WHOLE_NUMBERS = {
    'rate': (' Hz', 1, 100), 'branch_budget': ('', 1000, 20000000),
    'leaf_budget': ('', 1000, 3000000), 'threads': ('', 1, 64), 'width': (' pixel', 1, 4096),
    'height': (' pixel', 1, 4096), 'samples': ('', 1, 64),
}
OTHERS = {'frame_id', 'seed', 'camera_frame', 'camera_info_url', 'shadows'}
CALIBRATION = """image_width: %(width)d
image_height: 480
camera_name: camera
camera_matrix: {rows: 3, cols: 3, data: [%(focal)g, 0, 320, 0, 500, 240, 0, 0, 1]}
distortion_model: %(model)s
distortion_coefficients: {rows: 1, cols: 5, data: [%(k1)g, 0, 0, 0, 0]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0]}
"""


class CameraParameters(Ranges, RefusingNode):
    NODE = 'vegetation_camera'
    NUMBERS, WHOLE_NUMBERS, OTHERS = NUMBERS, WHOLE_NUMBERS, OTHERS

    def test_bad_names_and_words_are_rejected(self):
        refusal = self.refusal({'frame_id': '', 'camera_frame': '/eye', 'seed': -1,
                                'shadows': 'soft', 'camera_info_url': 7})
        for words in ("~frame_id = '' is empty", "~camera_frame = '/eye' begins with '/'", '~seed',
                      "~shadows = 'soft' is none of none, sun", '~camera_info_url = 7 is not text'):
            self.assertIn(words, refusal)
        self.assertIn("~camera_frame = '' is empty", self.refusal({'camera_frame': ''}))

    def test_inconsistent_values_are_rejected(self):
        self.assertIn('~range_max = 20.000000 is not above range_min = 50.000000',
                      self.refusal({'range_min': 50.0, 'range_max': 20.0}))
        self.assertIn('~the distortion k1 to k3 has no inverse at pixel (-0.5, -0.5)',
                      self.refusal({'k1': -0.6, 'field_of_view': 1.8}))

    def test_addresses_that_hold_no_calibration_are_rejected(self):
        for url in 'file:///none.yaml', 'http://host/a.yaml', 'package://nothing/a.yaml':
            self.assertIn("~camera_info_url = '%s' is no file:// or package:// address of a calibration"
                          % url, self.refusal({'camera_info_url': url}))

    def test_bad_calibrations_are_rejected(self):
        good = dict(width=640, focal=500, model='plumb_bob', k1=-0.1)
        for change, words in (({'width': 5000}, 'width = 4097 pixel is outside 1 to 4096 pixel'),
                              ({'focal': 0}, 'fx = 0 pixel is outside 1 to '),
                              ({'model': 'equidistant'},
                               "distortion_model = 'equidistant' is not plumb_bob"),
                              ({'k1': 30}, 'k1 = 30 is outside -10 to 10'),
                              ({'k1': -5}, 'the distortion k1 to k3 has no inverse at pixel')):
            with self.subTest(words=words), tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, 'lens.yaml')
                with open(name, 'w') as file:
                    file.write(CALIBRATION % {**good, **change})
                refusal = self.refusal({'camera_info_url': 'file://' + name})
                self.assertIn("~camera_info_url = 'file://%s': %s" % (name, words), refusal)


if __name__ == '__main__':
    rospy.init_node('camera_parameters_test')
    rostest.rosrun('vegetation_sim', 'camera_parameters', CameraParameters)
