# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of grass_field: the node through its ROS interface. forest_rig has the
rest."""
import subprocess

import roslib.packages
import rospy
from geometry_msgs.msg import Point
from vegetation_sim.msg import GrassEvent, GrassLayout, GrassState, TreadEvent, TreadLaw
from vegetation_sim.srv import ClearGrass, CutGrass, SampleGrass, SetGrassColours, Tread

from forest_rig import RATE, time_of
from given import given
from waiting import wait_for
from watched_node import Log, WatchedNode, publisher

FULL = 1.5  # tilt of fully crushed grass [rad]
SIDE = 16  # nodes along a side of a block


class Meadow(WatchedNode):
    """Client of one grass_field."""

    def __init__(self, name='/grass_field', namespace='/'):
        self.layout = Log(namespace + 'grass/layout', GrassLayout)
        self.state = Log(namespace + 'grass/state', GrassState)
        self.events = Log(namespace + 'grass/events', GrassEvent)
        self.tread = rospy.ServiceProxy(name + '/tread', Tread)
        self.cut = rospy.ServiceProxy(name + '/cut', CutGrass)
        self.set_colours = rospy.ServiceProxy(name + '/set_colours', SetGrassColours)
        self.clear = rospy.ServiceProxy(name + '/clear', ClearGrass)
        super().__init__(name, 'grass', name + '/sample', SampleGrass)

    def at(self, x, y, stamp=rospy.Time()):
        """Returns the sample at one point."""
        return self.samples([(x, y)], stamp)[0]

    def samples(self, places, stamp=rospy.Time()):
        request = SampleGrass._request_class()
        request.header.stamp = stamp
        request.points = [Point(x, y, 0.0) for x, y in places]
        answer = self._probe(request)
        if not answer.success:
            raise AssertionError(answer.message)
        return answer.samples

    def refusal(self, **request):
        """Returns the error of the service sample, or '' on success."""
        answer = self._probe(**request)
        return '' if answer.success else answer.message

    def hashes(self):
        """Returns the hashes of the trodden ground by stamps of the key frames."""
        return {m.header.stamp: m.hash for m in self.state.messages if m.key_frame}

    def trodden(self, prefix):
        """Returns the sources of the treads that were applied, in order, whose names begin so."""
        return [e.tread.source for e in self.events.messages
                if e.kind == GrassEvent.TREAD and e.tread.source.startswith(prefix)]

    def entered(self, source):
        """Returns the tiles that a source entered."""
        return [(e.column, e.row) for e in self.events.messages
                if e.kind == GrassEvent.ENTER and e.source == source]


class Feet:
    """Publishes treads."""

    def __init__(self, meadow, topic='/tread', readers=1):
        self.meadow = meadow
        self._publisher = publisher(topic, TreadEvent)
        wait_for(lambda: self._publisher.get_num_connections() >= readers, 'readers of ' + topic)

    def send(self, *messages):
        """Publishes messages. Returns when the node has received them."""
        for message in messages:
            self._publisher.publish(message)
        self.meadow.settle()

    def walk(self, clock, source, start, end, ticks, *others, **fields):
        """Walks from start to end in equal steps, one per tick."""
        for i in range(ticks + 1):
            part = i / ticks
            self.send(step(source, start[0] + part * (end[0] - start[0]),
                           start[1] + part * (end[1] - start[1]), **fields))
            for other in others:
                other.settle()
            clock.run(1, self.meadow, *others)

    def close(self):
        self._publisher.unregister()


def step(source, x, y, z=0.0, **fields):
    message = TreadEvent(source=source)
    message.position = Point(x, y, z)
    for name, value in fields.items():
        if name == 'law':
            message.law = TreadLaw(**given(**value))
        elif name == 'height_gate':
            message.has_height_gate, message.height_gate = True, value
        else:
            setattr(message, name, value)
    return message


def wide_stroke(source, start, end, **fields):
    """Returns a stroke of the largest reach, which presses millions of nodes."""
    return step(source, *end, action=TreadEvent.STROKE, start=Point(*start, 0.0),
                law={'reach': 10.0}, **fields)


def nodes_of(message):
    """Returns the values of the published nodes of a GrassState by row and column."""
    out = {}
    for block in message.blocks:
        present = [i for i in range(SIDE * SIDE) if block.included[i // 8] >> i % 8 & 1]
        for k, i in enumerate(present):
            press = block.press[k]
            out[SIDE * block.row + i // SIDE, SIDE * block.column + i % SIDE] = (
                block.tilt[k], block.x[k], block.y[k], message.press_stamps[press],
                message.press_recoveries[press])
    return out


def start_meadow(name, remappings, **parameters):
    """Starts a grass_field; the test must stop it."""
    rospy.set_param(name, parameters)
    executable = roslib.packages.find_node('vegetation_sim', 'grass_field')[0]
    namespace, _, node = name.rpartition('/')
    return subprocess.Popen([executable, '__name:=' + node, '__ns:=' + (namespace or '/')] +
                            ['%s:=%s' % pair for pair in remappings.items()])


__all__ = ['FULL', 'RATE', 'Feet', 'Meadow', 'nodes_of', 'start_meadow', 'step', 'time_of',
           'wide_stroke']
