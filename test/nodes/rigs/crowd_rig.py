# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of agent_crowd share, beside forest_rig: the node as its users see it."""
import math

import rospy
from geometry_msgs.msg import Point, TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import AgentStates, CrowdEvent, TreadEvent
from vegetation_sim.srv import RemoveAgents, SetAgentGoal, SpawnAgents

from waiting import wait_for
from watched_node import Log, WatchedNode, publisher, wait_for_readers


class Crowd(WatchedNode):
    """One agent_crowd as its users see it."""

    LOGS = 'state', 'events', 'tread'

    def __init__(self, name='/agent_crowd', namespace='/'):
        self.state = Log(namespace + 'agents', AgentStates)
        self.events = Log(namespace + 'agents/events', CrowdEvent)
        self.tread = Log(namespace + 'tread', TreadEvent)
        self.spawn = rospy.ServiceProxy(name + '/spawn', SpawnAgents)
        self.set_goal = rospy.ServiceProxy(name + '/set_goal', SetAgentGoal)
        self.reset = rospy.ServiceProxy(name + '/reset', Trigger)
        super().__init__(name, 'crowd', name + '/remove', RemoveAgents)

    def remove(self, **request):
        return self._probe(**request)

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


class Cart:
    """A robot's frame."""

    def __init__(self, crowd, frame='cart'):
        self.crowd = crowd
        self.frame = frame
        self._publisher = publisher('/tf', TFMessage)
        wait_for_readers('/tf', crowd.process)

    def put(self, x, y, stamp, yaw=0.0):
        """Returns when it is in the crowd's socket: its thread for tf may take it a tick later."""
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
