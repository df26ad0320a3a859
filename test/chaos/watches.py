# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Watches the memory and the ticks of the nodes."""
import math
import threading
import time
from collections import namedtuple

import rospy

from raw_messages import publisher_of, stamp_of
from scene import NANOSECONDS, NODES, TICKS

PERIOD = 1.0     # [s] of wall time between two looks at the memory
USED_MEMORY = 'Memory in use [B]'  # of the diagnostics
LONG_GAP = 0.15  # [s] of simulated time; shorter gaps are not kept

# Slope, its standard error, and the time from the first to the last sample.
Trend = namedtuple('Trend', 'slope error duration')


def trend_of(points):
    """Returns the trend of (time, value) pairs by linear regression."""
    count = len(points)
    if count < 3:
        return Trend(0.0, math.inf, 0.0)
    mean_at = sum(at for at, _ in points) / count
    mean = sum(value for _, value in points) / count
    spread = sum((at - mean_at) ** 2 for at, _ in points)
    slope = sum((at - mean_at) * (value - mean) for at, value in points) / spread
    squares = sum((value - mean - slope * (at - mean_at)) ** 2 for at, value in points)
    return Trend(slope, math.sqrt(squares / (count - 2) / spread), points[-1][0] - points[0][0])


def floors_of(samples, windows):
    """Returns the least of the (time, value) samples in each window. Nodes keep up to
    MOST_FREED_MEMORY of freed memory, which comes and goes; what they hold is the floor."""
    within = [[(value, at) for at, value in samples if begin <= at <= end] for begin, end in windows]
    return [(at, value) for value, at in map(min, filter(None, within))]


class MemoryWatch(threading.Thread):
    """Notes the anonymous memory of each node, and what it reports as in use: the allocator keeps
    freed memory, and pages of which it uses a part."""

    KINDS = 'anonymous', 'in use'

    def __init__(self, processes, clock, diagnosis):
        super().__init__(daemon=True)
        # By node and kind: time [s], process, memory [bytes].
        self.samples = {(node, kind): [] for node in NODES for kind in self.KINDS}
        self._processes, self._clock, self._diagnosis = processes, clock, diagnosis
        self._ended = threading.Event()

    def run(self):
        while not self._ended.wait(PERIOD):
            for node in NODES:
                found = self._processes.memory(node)
                if not found:
                    continue
                process, size = found
                self.samples[node, 'anonymous'].append((self._clock.now, process, size))
                report = self._diagnosis.newest(node, USED_MEMORY)
                if report and time.monotonic() - report.arrival < 2 * PERIOD:
                    self.samples[node, 'in use'].append(
                        (self._clock.now, process, int(report.values[USED_MEMORY])))

    def stop(self):
        self._ended.set()
        self.join()

    def write(self, path):
        """Writes all samples as a table of comma-separated values."""
        with open(path, 'w', encoding='utf-8') as file:
            file.write('node,memory,time [s],process,size [B]\n')
            for (node, kind), samples in self.samples.items():
                for at, process, size in samples:
                    file.write('%s,%s,%.3f,%d,%d\n' % (node, kind, at, process, size))

    def trend(self, node, kind, windows):
        """Returns the trend [bytes/h of simulated time] of the last process of a node: that of the
        least memory in each of these times."""
        samples = self.samples[node, kind]
        return trend_of([(at / 3600.0, size) for at, size in floors_of(
            [(at, size) for at, process, size in samples if process == samples[-1][1]], windows)])


class TickWatch:
    """Notes the gaps between the stamps of the ticks of each node."""

    def __init__(self):
        self.newest = dict.fromkeys(NODES, 0.0)   # stamp [s]
        self.arrival = dict.fromkeys(NODES, 0.0)  # of the newest [s] of wall time
        self.gaps = {node: [] for node in NODES}  # gap [s], wall times of both ends, begin
        self.count = dict.fromkeys(NODES, 0)
        self._subscribers = [
            rospy.Subscriber('/' + topic, rospy.AnyMsg, self._on_tick, node, tcp_nodelay=True)
            for node, topic in TICKS.items()]

    def connected(self):
        return all(subscriber.get_num_connections() for subscriber in self._subscribers)

    def _on_tick(self, message, node):
        if publisher_of(message) != node:  # a second publisher, or a flood
            return
        stamp, now = stamp_of(message._buff) / NANOSECONDS, time.monotonic()
        before, arrival = self.newest[node], self.arrival[node]
        self.arrival[node] = now
        if stamp <= before:
            return
        if before and stamp - before > LONG_GAP:
            self.gaps[node].append((stamp - before, arrival, now, before))
        self.newest[node] = stamp
        self.count[node] += 1

    def lag(self, now, excused):
        """Returns by how much the slowest node is behind a time [s], but for excused ones, and its
        name."""
        return max([(now - self.newest[node], node) for node in NODES
                    if self.newest[node] and node not in excused], default=(0.0, None))

    def largest_gap(self, node, is_disturbed):
        """Returns the largest gap [s] at a time at which the node was not disturbed, and its
        begin [s]."""
        return max([(gap, stamp) for gap, begin, end, stamp in self.gaps[node]
                    if not is_disturbed(node, begin, end)], default=(0.0, 0.0))
