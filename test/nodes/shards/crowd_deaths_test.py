#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""After kill -9 of a shard of a crowd that has no checkpoint, roslaunch starts it again. Each person is
then in one shard: those whom it had begin anew, the others go on."""
import math
import os
import signal
import unittest

import rospy
import rostest
from vegetation_sim.msg import AgentStates
from vegetation_sim.srv import FindAgents

from waiting import DEADLINE, wait_for
from watched_node import Log, slave

PEOPLE, SHARDS = 60, 3
STEADY = 60    # ticks in a row that have all people
FASTEST = 2.0  # [m/s] that a person walks
LONGEST = 0.3  # [m] that a person is moved by encounters besides


def people_of(shard):
    """Returns the ids of those whom a shard has, or [] if it does not run."""
    try:
        name = '/crowd_%d/owned/find_agents' % shard
        return list(rospy.ServiceProxy(name, FindAgents)(all=True).ids)
    except (rospy.ServiceException, rospy.ROSException):
        return []


def people_of_all():
    """Who crosses a border meanwhile may be missing or in two shards."""
    return sorted(sum([people_of(shard) for shard in range(SHARDS)], []))


def jumped(message, later):
    """Returns the ids of those who are farther away in a later message than people walk."""
    farthest = LONGEST + FASTEST * (later.header.stamp - message.header.stamp).to_sec()
    places = {agent.id: agent.pose.position for agent in message.agents}
    return [agent.id for agent in later.agents if agent.id in places and math.hypot(
        agent.pose.position.x - places[agent.id].x, agent.pose.position.y - places[agent.id].y) > farthest]


def steady(messages, stamp):
    """Returns the first of the last STEADY messages if they are later than stamp and have all people."""
    last = messages[-STEADY:]
    are_all = all([agent.id for agent in message.agents] == list(range(PEOPLE)) for message in last)
    return are_all and last[0].header.stamp > stamp and last[0]


class CrowdDeaths(unittest.TestCase):
    def test_each_person_is_in_one_shard_after_a_death(self):
        agents = Log('/agents', AgentStates)
        for shard in range(SHARDS):
            rospy.wait_for_service('/crowd_%d/owned/find_agents' % shard, DEADLINE)
        all_people = list(range(PEOPLE))
        wait_for(lambda: people_of_all() == all_people, 'people at first')
        for dead in ((1,), (0,), (2,), (0, 1)):
            rospy.sleep(3.0)  # in which people cross borders
            before, lost = agents.messages[-1], set()
            for shard in dead:
                lost.update(wait_for(lambda i=shard: people_of(i), 'people of shard %d' % shard))
            self.assertGreater(len(lost), 5)
            for shard in dead:
                os.kill(slave('/crowd_%d' % shard).getPid('/crowd_deaths_test')[2], signal.SIGKILL)
            wait_for(lambda: not people_of(dead[0]), 'the death')  # pylint: disable=cell-var-from-loop
            wait_for(lambda: people_of_all() == all_people, 'people after the death of shards %s' % str(dead))
            stamp = rospy.Time.now()
            after = agents.wait(lambda all: steady(all, stamp), 'steady people')
            since = [m for m in list(agents.messages) if before.header.stamp <= m.header.stamp <= after.header.stamp]
            moved = {i for one, next_ in zip(since, since[1:]) for i in jumped(one, next_)}
            self.assertLessEqual(len(moved - lost), 2)  # who crossed the border meanwhile
            if 0 not in dead:  # which shows all
                for message in since:
                    self.assertEqual([agent.id for agent in message.agents], all_people)


if __name__ == '__main__':
    rospy.init_node('crowd_deaths_test')
    rostest.rosrun('vegetation_sim', 'crowd_deaths', CrowdDeaths)
