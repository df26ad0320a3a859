# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of agent_crowd."""
from vegetation_sim.client import Client, given, point, stamped
from vegetation_sim.msg import AgentSpawn
from vegetation_sim.srv import RemoveAgents, SetAgentGoal, SpawnAgents


class Crowd(Client):
    """People. Places are (x, y) in the world frame [m]."""

    def __init__(self, node='/agent_crowd', timeout=30.0):
        super().__init__(node, timeout)

    def spawn(self, position, count=1, spread=0.0, heading=0.0, goal=None, stands=False, speed=None,
              radius=None, height=None):
        """Adds walkers around a position. Returns their ids."""
        like = AgentSpawn(position=point(position), heading=heading, stands=stands,
                          has_goal=goal is not None, goal=point(goal or (0, 0)),
                          **given(speed=speed, radius=radius, height=height))
        return list(self.call('spawn', SpawnAgents, like=like, count=count, spread=spread).ids)

    def send(self, ids, goal):
        """Sends walkers to a goal."""
        self.call('set_goal', SetAgentGoal, ids=ids, goal=stamped(goal))

    def wander(self, ids):
        """Lets walkers choose their goals."""
        self.call('set_goal', SetAgentGoal, ids=ids, wander=True)

    def remove(self, ids):
        self.call('remove', RemoveAgents, ids=ids)

    def clear(self):
        """Removes all walkers."""
        self.call('remove', RemoveAgents, all=True)
