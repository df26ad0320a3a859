#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""media/demo.bag plays: its messages are of this version, and have what the displays draw."""
import unittest

import rospy
import rostest
from vegetation_sim.msg import (AgentStates, CanopyLayout, CanopyState, ForestLayout, ForestState,
                                GrassLayout, GrassState, WindField)

from watched_node import Log

TOPICS = {'agents': AgentStates, 'canopy/layout': CanopyLayout, 'canopy/state': CanopyState,
          'forest/layout': ForestLayout, 'forest/view': ForestState, 'grass/layout': GrassLayout,
          'grass/state': GrassState, 'wind': WindField}


class Bag(unittest.TestCase):
    def test_every_topic_comes(self):
        logs = {topic: Log('/' + topic, kind) for topic, kind in TOPICS.items()}
        for topic, log in logs.items():
            log.wait(len, topic)
            self.assertEqual(log.messages[0].header.frame_id, 'world')
        log = logs['forest/view']
        log.wait(lambda all: any(message.key_frame for message in all), 'a complete state')
        for state, layout in (('forest/view', 'forest/layout'), ('grass/state', 'grass/layout')):
            self.assertEqual(logs[state].messages[0].layout_hash, logs[layout].messages[0].hash)
        self.assertTrue(logs['agents'].messages[0].agents)


if __name__ == '__main__':
    rospy.init_node('bag_test')
    rostest.rosrun('vegetation_sim', 'bag', Bag)
