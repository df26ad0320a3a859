# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of canopy_animator: the node through its ROS interface. forest_rig has the
rest."""
import struct
import subprocess

import roslib.packages
import rospy
from geometry_msgs.msg import Point
from std_msgs.msg import Header
from vegetation_sim.msg import CanopyEvent, CanopyLayout, CanopyState
from vegetation_sim.srv import SampleCanopy

from forest_rig import TickClock
from watched_node import Log, WatchedNode


class Leaves(WatchedNode):
    """Client of one canopy_animator."""

    def __init__(self, name='/canopy_animator', namespace='/'):
        self.layout = Log(namespace + 'canopy/layout', CanopyLayout)
        self.state = Log(namespace + 'canopy/state', CanopyState)
        self.events = Log(namespace + 'canopy/events', CanopyEvent)
        super().__init__(name, 'canopy', name + '/sample', SampleCanopy)

    def at(self, x, y, z):
        """Returns the sample at one point."""
        return self.samples((x, y, z)).samples[0]

    def samples(self, *places):
        answer = self._probe(points=[Point(*place) for place in places])
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def refusal(self, *places, **header):
        """Returns the error of the service sample, or '' on success."""
        answer = self._probe(header=Header(**header), points=[Point(*place) for place in places])
        return '' if answer.success else answer.message

    def hashes(self):
        """Returns the published state hashes by stamp."""
        return {m.header.stamp: m.hash for m in self.state.messages if m.hash}


class ReplayedLeaves:
    """Base of a test case: a canopy_animator, one in /again that replays it, and their clock."""

    def begin(self, first_tick):
        self.leaves, self.clock = Leaves(), TickClock(first_tick)
        self.again = Leaves('/again/canopy_animator', '/again/')
        self.again.events = self.leaves.events
        self.again.wait_until_up('/wind', '/canopy/events')
        self.clock.begin(self.leaves)
        self.run_ticks(10)

    def run_ticks(self, count):
        """Runs single ticks; before each one the replay has received the events of the previous
        tick."""
        for _ in range(count):
            self.clock.run(1, self.leaves)
            self.again.settle()


def half(bits):
    """Returns the value of a number in half precision."""
    return struct.unpack('<e', struct.pack('<H', bits))[0]


def start_leaves(name, remappings, **parameters):
    """Starts a canopy_animator; the test must stop it."""
    rospy.set_param(name, parameters)
    executable = roslib.packages.find_node('vegetation_sim', 'canopy_animator')[0]
    namespace, _, node = name.rpartition('/')
    return subprocess.Popen([executable, '__name:=' + node, '__ns:=' + (namespace or '/')] +
                            ['%s:=%s' % pair for pair in remappings.items()])
