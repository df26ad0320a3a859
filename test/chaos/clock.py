# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A clock that is faster than real time, steady or with jitter."""
import threading
import time
from collections import defaultdict

import rospy
from rosgraph_msgs.msg import Clock

from scene import NANOSECONDS, START
from watched_node import publisher

PERIOD = 0.01       # [s] of wall time between two messages
LONGEST_STEP = 0.1  # of simulated time [s], also after a pause of this process
MOST_LAG = 0.4      # [s] of simulated time by which nodes may be behind before the clock waits
LONGEST_WAIT = 5.0  # [s] of wall time; then a node counts as dead and the clock goes on
SPEEDS = 0.0, 0.3, 1.0, 1.0, 3.0  # of a clock with jitter, relative to the steady one
SMALL_STEPS_BACK = 0.01, 0.09     # [s]; nodes ride out steps of up to 0.1 s


class FastClock(threading.Thread):
    """Publishes /clock, and the frames of a robot with it. It waits for nodes that lag behind."""

    def __init__(self, factor, robot, lag, random):
        """`lag(now)` returns by how much the slowest node is behind the time `now` [s], and its
        name."""
        super().__init__(daemon=True)
        self.now = START
        self.jitter = False
        self.waited = 0.0  # for nodes [s] of wall time
        self.longest_waits = defaultdict(lambda: (0.0, 0.0))  # [s] of wall time; and when it was
        self._factor, self._robot, self._lag, self._random = factor, robot, lag, random
        # Without a queue, frames are in the sockets of the nodes before the time that needs them.
        self._publisher = publisher('/clock', Clock)
        self._ended = threading.Event()

    def readers(self):
        return self._publisher.get_num_connections()

    def run(self):
        last, waits_since = time.monotonic(), None
        while not self._ended.wait(PERIOD):
            wall = time.monotonic()
            passed, last = wall - last, wall
            lag, node = self._lag(self.now)
            if lag > MOST_LAG:
                waits_since = waits_since or wall
                if wall - waits_since < LONGEST_WAIT:
                    self._count_wait(node, passed, wall - waits_since)
                    continue
            else:
                waits_since = None
            self._advance(passed)

    def _count_wait(self, node, passed, wait):
        self.waited += passed
        self.longest_waits[node] = max(self.longest_waits[node], (wait, self.now))

    def _advance(self, passed):
        speed = self._random.choice(SPEEDS) if self.jitter else 1.0
        self.now += min(LONGEST_STEP, speed * self._factor * passed)
        self._robot.publish(self.now)
        self.publish(self.now)
        if self.jitter and self._random.random() < 0.2:
            self.publish(self.now - self._random.uniform(*SMALL_STEPS_BACK))

    def publish(self, seconds):
        self._publisher.publish(Clock(rospy.Time(0, int(seconds * NANOSECONDS))))

    def stop(self):
        """Lets time stand still."""
        self._ended.set()
        self.join()
