#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Recording: any tick of a recorded run is the run's, and a bag without one event is found out."""
import os
import re
import shutil
import tempfile
import unittest

import roslib.packages
import rosbag
import rospy
import rostest
from vegetation_sim import Crowd, Recording, Simulation, VegetationError
from vegetation_sim.msg import AgentStates, CrowdEvent

from forest_rig import scene, start_node, stop
from watched_node import Log

TICKS = 200
WATCH = {'agents': AgentStates}


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.bag = os.path.join(cls.folder, 'run.bag')
        cls.record_run()
        cls.process = start_node('agent_crowd', '/agent_crowd', {}, scenario=scene('crowd'),
                                 replay=True)
        rospy.wait_for_service('/agent_crowd/tf2_frames', 30.0)

    @classmethod
    def tearDownClass(cls):
        stop(cls.process)
        shutil.rmtree(cls.folder)

    @classmethod
    def record_run(cls):
        """Runs a node with requests, and writes its states and events."""
        process = start_node('agent_crowd', '/agent_crowd', {}, scenario=scene('crowd'))
        logs = {'/agents': Log('/agents', AgentStates),
                '/agents/events': Log('/agents/events', CrowdEvent)}
        simulation, crowd = Simulation(WATCH), Crowd()
        for log in logs.values():
            log.wait(lambda _, log=log: log.connected(), 'the publisher')
        simulation.reset()
        for step in range(TICKS):
            if step % 20 == 10:
                crowd.send([0, 1], (0.03 * step - 5.0, 5.0))
            if step == 60:
                crowd.spawn((3, 3), count=2, spread=1.0)
            simulation.step()
        last = simulation.stamp()
        logs['/agents'].wait_for_stamp(last)
        logs['/agents/events'].wait(lambda all: sum(e.kind == CrowdEvent.GOAL for e in all) == 20,
                                    'all goals')
        with rosbag.Bag(cls.bag, 'w') as bag:
            for topic, log in logs.items():
                for message in log.messages:
                    bag.write(topic, message, message.header.stamp)
                log.close()
        cls.hashes = {m.header.stamp: m.hash for m in logs['/agents'].messages}
        simulation.close()
        stop(process)

    def seek(self, recording, tick):
        stamp = sorted(self.hashes)[tick]
        found = recording.seek(stamp)['/agents']
        self.assertEqual((found.header.stamp, found.hash), (stamp, self.hashes[stamp]))

    def test_any_tick_is_that_of_the_run(self):
        recording = Recording(self.bag, WATCH)
        self.assertEqual(recording.first, min(self.hashes))
        for tick in (120, 121, 30, 199, 70):
            self.seek(recording, tick)
        with self.assertRaisesRegex(VegetationError, 'stamp = 1.000000000 s is outside 1000'):
            recording.seek(rospy.Time(1))
        recording.close()

    def test_a_recording_without_one_event_differs(self):
        altered = os.path.join(self.folder, 'altered.bag')
        with rosbag.Bag(self.bag) as whole, rosbag.Bag(altered, 'w') as bag:
            for topic, message, time in whole.read_messages():
                if getattr(message, 'kind', None) != CrowdEvent.SPAWN:
                    bag.write(topic, message, time)
        recording = Recording(altered, WATCH)
        self.seek(recording, 40)
        with self.assertRaisesRegex(VegetationError, 'on /agents differs from the recorded one'):
            recording.seek(sorted(self.hashes)[100])
        recording.close()

    def test_the_lines_of_the_page_run(self):
        page = roslib.packages.get_pkg_dir('vegetation_sim') + '/docs/lockstep.md'
        with open(page) as file:
            block, = re.findall('^```python\n(.*?)^```', file.read(), re.S | re.M)
        self.assertIn("'run.bag'", block)
        names = {}
        exec(block.replace('run.bag', self.bag), names)
        self.assertEqual(names['states']['/agents'].hash, self.hashes[max(self.hashes)])
        names['recording'].close()

    def test_files_that_are_no_recordings_are_rejected_by_name(self):
        with self.assertRaisesRegex(VegetationError, 'none.bag: cannot be read'):
            Recording(os.path.join(self.folder, 'none.bag'), WATCH)
        empty = os.path.join(self.folder, 'empty.bag')
        rosbag.Bag(empty, 'w').close()
        with self.assertRaisesRegex(VegetationError, 'empty.bag: no message on agents'):
            Recording(empty, WATCH)


if __name__ == '__main__':
    rospy.init_node('recording_test')
    rostest.rosrun('vegetation_sim', 'recording', RecordingTest)
