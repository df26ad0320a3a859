# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of canopy_animator share, beside forest_rig: the node as its users see it."""
import struct
import subprocess

import roslib.packages
import rospy
from geometry_msgs.msg import Point
from std_msgs.msg import Header
from vegetation_sim.msg import CanopyEvent, CanopyLayout, CanopyState
from vegetation_sim.srv import SampleCanopy

from watched_node import Log, WatchedNode


class Leaves(WatchedNode):
    """One canopy_animator as its users see it."""

    def __init__(self, name='/canopy_animator', namespace='/'):
        self.layout = Log(namespace + 'canopy/layout', CanopyLayout)
        self.state = Log(namespace + 'canopy/state', CanopyState)
        self.events = Log(namespace + 'canopy/events', CanopyEvent)
        super().__init__(name, 'canopy', name + '/sample', SampleCanopy)

    def at(self, x, y, z):
        """Leaves at one place."""
        return self.samples((x, y, z)).samples[0]

    def samples(self, *places):
        answer = self._probe(points=[Point(*place) for place in places])
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def refusal(self, *places, **header):
        """Message with which sample refuses."""
        answer = self._probe(header=Header(**header), points=[Point(*place) for place in places])
        return '' if answer.success else answer.message

    def hashes(self):
        """Hash of all that it remembers by stamp, where it was told."""
        return {m.header.stamp: m.hash for m in self.state.messages if m.hash}


def half(bits):
    """A number in half precision."""
    return struct.unpack('<e', struct.pack('<H', bits))[0]


def start_leaves(name, remappings, **parameters):
    """Starts a canopy_animator that the test ends itself."""
    rospy.set_param(name, parameters)
    executable = roslib.packages.find_node('vegetation_sim', 'canopy_animator')[0]
    namespace, _, node = name.rpartition('/')
    return subprocess.Popen([executable, '__name:=' + node, '__ns:=' + (namespace or '/')] +
                            ['%s:=%s' % pair for pair in remappings.items()])
