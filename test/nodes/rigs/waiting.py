# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of the nodes: waiting for conditions and publishing the clock."""
import threading
import time

import rospy
from rosgraph_msgs.msg import Clock

DEADLINE = 60.0  # [s] of wall time; only a test that fails waits this long


def wait_for(condition, what, seconds=DEADLINE):
    """Returns the first true value of `condition()`. Fails after the deadline."""
    pause = threading.Event()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        pause.wait(0.01)
    raise AssertionError('timed out waiting for ' + what)


class Latest:
    """Keeps the newest message of a topic."""

    def __init__(self, topic, message_type):
        self.count = 0
        self.message = None
        self._subscriber = rospy.Subscriber(topic, message_type, self._on_message, queue_size=100)

    def _on_message(self, message):
        self.message = message
        self.count += 1


class SimulatedClock:
    """Publishes the clock of a test. Time stands still between calls."""

    def __init__(self):
        self.now = rospy.Time(0)
        self._publisher = rospy.Publisher('/clock', Clock, queue_size=1000, latch=True)

    def wait_for_listeners(self, count):
        wait_for(lambda: self._publisher.get_num_connections() >= count, 'listeners of /clock')

    def set(self, stamp):
        self.now = stamp
        self._publisher.publish(Clock(clock=stamp))

    def run(self, seconds, step=0.02, each=None):
        """Advances time in steps, at 20 times the speed of wall time."""
        pause = threading.Event()
        for _ in range(int(round(seconds / step))):
            self.set(self.now + rospy.Duration.from_sec(step))
            if each:
                each(self.now)
            pause.wait(step / 20.0)
