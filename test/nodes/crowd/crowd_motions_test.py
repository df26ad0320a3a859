#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Test S2-35: agent_crowd reads the files of the styles in docs/crowd.md, of its scenario or of its
parameter, and publishes their angles."""
import math
import re
import signal
import subprocess
import tempfile
import textwrap
import unittest

import roslib.packages
import rospy
import rostest
import yaml
from vegetation_sim.msg import CrowdMotions

from waiting import DEADLINE
from watched_node import Log

KEYS, CHANNELS = 32, 18
WALK, STAND, TURN = range(3)
PELVIS_YAW, PELVIS_ROLL, TRUNK_YAW = range(3)


def documented():
    """Returns the block of docs/crowd.md."""
    with open(roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/crowd.md') as page:
        block = re.search(r'^    motions:\n(?:      .*\n)+', page.read(), re.M).group()
    return yaml.safe_load(textwrap.dedent(block))


class CrowdMotionsTest(unittest.TestCase):
    def styles(self, namespace, parameters):
        """Starts a node and returns the styles that it publishes."""
        rospy.set_param('/%s/agent_crowd' % namespace, parameters)
        log = Log('/%s/agents/motions' % namespace, CrowdMotions)
        executable = roslib.packages.find_node('vegetation_sim', 'agent_crowd')[0]
        process = subprocess.Popen([executable, '__ns:=/' + namespace])
        try:
            log.wait(len, 'styles')
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(DEADLINE)
            log.close()
        return log.messages[-1]

    def expect_march(self, message):
        """The angles are those by which scripts/make_motions.py made the files."""
        def angle(clip, key, channel):
            return math.degrees(message.angles[(clip * KEYS + key) * CHANNELS + channel])

        self.assertEqual(message.names, ['march'])
        self.assertEqual(len(message.angles), 3 * KEYS * CHANNELS)
        self.assertAlmostEqual(message.stand_period[0], 3.0, delta=0.001)
        self.assertAlmostEqual(angle(WALK, 0, PELVIS_YAW), -7.0, delta=1.0)
        self.assertAlmostEqual(angle(WALK, 16, PELVIS_YAW), 7.0, delta=1.0)
        self.assertAlmostEqual(angle(STAND, 8, PELVIS_ROLL), 3.0, delta=0.2)
        # Ten degrees of the trunk at 40 degrees per second, for 1 rad/s.
        self.assertAlmostEqual(angle(TURN, 10, TRUNK_YAW), 10.0 / math.radians(40.0), delta=0.5)

    def test_styles_of_a_scenario(self):
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            yaml.safe_dump({'frame_id': 'map', 'crowd': documented()}, file)
            file.flush()
            self.expect_march(self.styles('scenario', {'scenario': file.name}))

    def test_styles_of_a_parameter(self):
        self.expect_march(self.styles('parameter', documented()))

    def test_without_files_there_are_the_own_styles(self):
        self.assertEqual(self.styles('own', {'tread': 'none'}).names, ['calm', 'brisk', 'tired'])


if __name__ == '__main__':
    rospy.init_node('crowd_motions_test')
    rostest.rosrun('vegetation_sim', 'crowd_motions_test', CrowdMotionsTest)
