# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of agent_crowd share, beside forest_rig: the node as its users see it."""
import math

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import AgentStates, CrowdEvent, TreadEvent
from vegetation_sim.srv import RemoveAgents, SetAgentGoal, SpawnAgents

from forest_rig import Log, listens, publisher
from waiting import DEADLINE, wait_for


class Crowd:
    """One agent_crowd as its users see it."""

    def __init__(self, name='/agent_crowd', namespace='/'):
        self.name = name
        self.process = name  # node that it lives in
        self.state = Log(namespace + 'agents', AgentStates)
        self.events = Log(namespace + 'agents/events', CrowdEvent)
        self.tread = Log(namespace + 'tread', TreadEvent)
        self.spawn = rospy.ServiceProxy(name + '/spawn', SpawnAgents)
        self.remove = rospy.ServiceProxy(name + '/remove', RemoveAgents, persistent=True)
        self.set_goal = rospy.ServiceProxy(name + '/set_goal', SetAgentGoal)
        self.reset = rospy.ServiceProxy(name + '/reset', Trigger)

    def wait_until_up(self, *topics):
        self.remove.wait_for_service(DEADLINE)
        self.settle()
        for topic in ('/clock',) + topics:
            wait_for(lambda: listens(self.process, topic), '%s to hear %s' % (self.name, topic))
        for log in (self.state, self.events, self.tread):
            wait_for(log.connected, log.topic)

    def settle(self):
        """Returns when it has taken all that was published before."""
        for _ in range(2):
            self.remove()  # of nobody: refused

    def agents(self):
        """Those of the last tick, by id."""
        return {agent.id: agent for agent in self.state.messages[-1].agents}

    def hashes(self):
        return {m.header.stamp: m.hash for m in self.state.messages}

    def expect_event(self, kind, fits=lambda event: True):
        """The newest event of a kind that fits; waits for it."""
        def newest():
            found = [e for e in self.events.messages if e.kind == kind and fits(e)]
            return found[-1] if found else None
        return wait_for(newest, 'an event of kind %d' % kind)

    def diagnostics(self):
        log = Log('/diagnostics', DiagnosticArray)
        name = self.name.lstrip('/') + ': crowd'
        log.wait(lambda all: any(s.name == name for m in all for s in m.status), name)
        log.close()
        status = [s for m in log.messages for s in m.status if s.name == name][-1]
        return {pair.key: int(pair.value) for pair in status.values}


class Cart:
    """A robot's frame."""

    def __init__(self, crowd, frame='cart'):
        self.crowd = crowd
        self.frame = frame
        self._publisher = publisher('/tf', TFMessage)
        wait_for(lambda: self._publisher.get_num_connections() > 0, 'readers of /tf')

    def put(self, x, y, stamp, yaw=0.0):
        """Returns when the crowd has heard it."""
        frame = TransformStamped(child_frame_id=self.frame)
        frame.header.frame_id = 'map'
        frame.header.stamp = stamp
        frame.transform.translation.x, frame.transform.translation.y = x, y
        frame.transform.rotation.z = math.sin(0.5 * yaw)
        frame.transform.rotation.w = math.cos(0.5 * yaw)
        self._publisher.publish(TFMessage([frame]))
        self.crowd.settle()


def distance(a, b):
    return math.hypot(a.x - b.x, a.y - b.y)


def at(x, y):
    return Point(x, y, 0.0)
