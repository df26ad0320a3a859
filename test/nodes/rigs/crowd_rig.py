# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of agent_crowd: the node through its ROS interface. forest_rig has the
rest."""
import math

import rospy
from geometry_msgs.msg import Point, TransformStamped
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import AgentStates, CrowdEvent, TreadEvents
from vegetation_sim.srv import RemoveAgents, SetAgentGoal, SpawnAgents

from waiting import wait_for
from watched_node import Log, WatchedNode, publisher, wait_for_readers


class Crowd(WatchedNode):
    """Client of one agent_crowd."""

    LOGS = 'state', 'events', 'treads'

    def __init__(self, name='/agent_crowd', namespace='/'):
        self.state = Log(namespace + 'agents', AgentStates)
        self.events = Log(namespace + 'agents/events', CrowdEvent)
        self.treads = Log(namespace + 'treads', TreadEvents)
        self.spawn = rospy.ServiceProxy(name + '/spawn', SpawnAgents)
        self.set_goal = rospy.ServiceProxy(name + '/set_goal', SetAgentGoal)
        self.reset = rospy.ServiceProxy(name + '/reset', Trigger)
        super().__init__(name, 'crowd', name + '/remove', RemoveAgents)

    def remove(self, **request):
        return self._probe(**request)

    def agents(self):
        """Returns the agents of the last tick by id."""
        return {agent.id: agent for agent in self.state.messages[-1].agents}

    def hashes(self):
        return {m.header.stamp: m.hash for m in self.state.messages}

    def tread_events(self):
        """Returns the treads of all people, in order."""
        return [event for message in self.treads.messages for event in message.events]

    def expect_event(self, kind, fits=lambda event: True):
        """Waits for an event of a kind that fulfils `fits`. Returns the newest one."""
        def newest():
            found = [e for e in self.events.messages if e.kind == kind and fits(e)]
            return found[-1] if found else None
        return wait_for(newest, 'an event of kind %d' % kind)


class Cart:
    """Publishes the frame of a robot."""

    def __init__(self, crowd, frame='cart'):
        self.crowd = crowd
        self.frame = frame
        self._publisher = publisher('/tf', TFMessage)
        wait_for_readers('/tf', crowd.process)

    def put(self, x, y, stamp, yaw=0.0):
        """Publishes the frame. Returns when it is in the socket of the crowd, whose tf thread may
        read it a tick later."""
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
