#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Episodes of people on grass are equal in lock-step, however late treads and covers come."""
import queue
import random
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid
from vegetation_sim import Crowd, Simulation
from vegetation_sim.msg import AgentStates, GrassState, TreadEvents

from waiting import wait_for
from watched_node import Log, listens

WAIT = 2.0  # frame_wait of the nodes [s]
STEPS = 90  # some of which have complete states of grass, with a hash
LONGEST_DELAY = 0.03  # of a message, by wall time [s]


class LateTopic:
    """Passes the messages of a topic on to another in their order, each some time later."""

    def __init__(self, source, target, kind):
        self.holds = threading.Event()  # while it is set, messages wait
        self._waiting, self._random, self._pause = queue.Queue(), random.Random(7), threading.Event()
        self._publisher = rospy.Publisher(target, kind, queue_size=1000, tcp_nodelay=True)
        self._subscriber = rospy.Subscriber(source, kind, self._waiting.put, tcp_nodelay=True)
        threading.Thread(target=self._pass_on, daemon=True).start()

    def connected(self):
        return self._publisher.get_num_connections() and self._subscriber.get_num_connections()

    def _pass_on(self):
        while not rospy.is_shutdown():
            message = self._waiting.get()
            self._pause.wait(self._random.uniform(0.0, LONGEST_DELAY))
            while self.holds.is_set():
                self._pause.wait(0.01)
            self._publisher.publish(message)


class PeopleOnGrass(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.treads = LateTopic('/treads_of_crowd', '/late_treads', TreadEvents)
        cls.covers = LateTopic('/grass/cover/resistance', '/late_cover', OccupancyGrid)
        cls.simulation = Simulation({'agents': AgentStates, 'grass/state': GrassState})
        cls.crowd = Crowd()
        for topic in (cls.treads, cls.covers):
            wait_for(topic.connected, 'late topics')
        # The first message of a crowd says that it is to be awaited.
        sent = Log('/late_treads', TreadEvents)
        cls.simulation.reset()
        wait_for(lambda: cls.simulation.step() and sent.messages, 'treads')

    def reported(self, what):
        """Returns the value of a count in the next reports."""
        def find(messages):
            return [value.value for message in list(messages) for status in message.status
                    for value in status.values if value.key == what]
        reports = Log('/diagnostics', DiagnosticArray)
        return reports.wait(find, what)[-1]

    def episode(self):
        hashes = []
        self.simulation.reset()
        for step in range(STEPS):
            if step % 20 == 0:
                self.crowd.send([0, 1], (0.1 * step - 5.0, 5.0))
            seen = self.simulation.step()
            hashes.append((seen['/agents'].hash, seen['/grass/state'].hash))
        return hashes

    def test_episodes_are_equal(self):
        first = self.episode()
        self.assertGreater(len({grass for _, grass in first}), 1)
        self.assertEqual(self.episode(), first)
        self.assertEqual(self.episode(), first)
        for what in ('Cover maps awaited in vain', 'Treads of crowds awaited in vain'):
            self.assertEqual(self.reported(what), '0')

    def test_one_crowd_that_hangs_delays_one_tick_and_is_named(self):
        reports = Log('/diagnostics', DiagnosticArray)
        wait_for(reports.connected, 'diagnostics')
        self.simulation.step()
        self.treads.holds.set()
        begin = time.monotonic()
        self.simulation.step(3)
        self.assertLess(time.monotonic() - begin, 1.5 * WAIT)
        reports.wait(lambda messages: any(
            'treads did not come within frame_wait' in status.message
            for message in list(messages) for status in message.status), 'the report')
        self.treads.holds.clear()


if __name__ == '__main__':
    rospy.init_node('people_on_grass_test')
    rostest.rosrun('vegetation_sim', 'people_on_grass', PeopleOnGrass)
