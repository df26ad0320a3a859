# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Outputs of nodes in shards and of single nodes, by tick."""
import collections

from vegetation_sim.msg import AgentStates, ContactForces, CrowdPart

from waiting import wait_for
from watched_node import Log, listens

CROWDS = 2  # shards of the crowd


class People:
    """The people of the crowds in shards and of the single one."""

    def __init__(self):
        self._logs = [Log(topic, AgentStates) for topic in ('/agents', '/whole/agents')]
        self._parts = Log('/agents/parts', CrowdPart)

    def wait_for_links(self):
        for log in (*self._logs, self._parts):
            wait_for(log.connected, log.topic)
        wait_for(lambda: all(listens('/crowd_%d' % i, '/agents/border') for i in range(CROWDS)), 'borders')
        wait_for(lambda: listens('/crowd_0', '/agents/parts'), 'parts')

    def compare(self, stamp):
        """Waits for the people of the last tick. Returns the number of ticks at which both have people,
        of those at which these are equal, and of people who have come to shard 1."""
        divided, whole = ({m.header.stamp: m for m in (log.wait_for_stamp(stamp), *log.messages)}
                          for log in self._logs)
        both = set(divided) & set(whole)
        equal = [s for s in both if divided[s].hash == whole[s].hash and divided[s].agents == whole[s].agents]
        ids = [{agent.id for agent in message.people.agents} for message in self._parts.messages]
        return len(both), len(equal), len(set().union(*ids) - ids[0])


def _vector(value):
    return value.x, value.y, value.z


def _values_of(force):
    """Returns all values of a force; the numbers of grabs are those of the shards."""
    return (force.grab > 0, force.body, force.tree, force.branch, force.along, _vector(force.point),
            _vector(force.force), force.frame, _vector(force.wrench.force), _vector(force.wrench.torque),
            force.limited, force.penetration)


class Forces:
    """The forces of branches on bodies and holders, and their wrenches in the frames of these."""

    def __init__(self):
        self._logs = [Log(topic, ContactForces) for topic in ('/forest/forces', '/whole/forest/forces')]

    def wait_for_links(self):
        for log in self._logs:
            wait_for(log.connected, log.topic)

    def compare(self):
        """Returns the number of ticks at which both have messages, of those with the same forces to
        the bit, and the numbers of forces of the single node on bodies and on holders with a frame."""
        divided, whole = (self._by_stamp(log) for log in self._logs)
        both = set(divided) & set(whole)
        equal = [stamp for stamp in both if divided[stamp] == whole[stamp]]
        if len(equal) < len(both):
            first = min(both - set(equal))
            for name, forces in (('shards', divided), ('one node', whole)):
                others = [values for values in forces[first] if values not in (divided, whole)[name == 'shards'][first]]
                print('different forces of %s at %s: %s' % (name, first, others[:3]))
        all_of = [values for list_ in whole.values() for values in list_]
        return len(both), len(equal), (sum(not v[0] for v in all_of), sum(v[0] and v[7] != '' for v in all_of))

    @staticmethod
    def _by_stamp(log):
        out = collections.defaultdict(list)
        for message in log.messages:
            out[message.header.stamp] += [_values_of(force) for force in message.forces]
        return {stamp: sorted(values) for stamp, values in out.items()}
