#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two nodes that share the people of a place are one crowd: the people of both are at each tick those
of a single node, also after one was killed, and requests through either node have the same effect."""
import os
import shutil
import signal
import tempfile
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from vegetation_sim.msg import AgentSpawn, AgentStates, CrowdBorder, CrowdPart, ErrorCode
from vegetation_sim.srv import RemoveAgents, SetAgentGoal, SpawnAgents
from visualization_msgs.msg import MarkerArray

from forest_rig import RATE, start_node, stop, time_of
from waiting import DEADLINE, SimulatedClock, wait_for
from watched_node import Log, all_delivered, listens, publisher

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'crowd_shards.yaml')
FIRST, PEOPLE, SHARDS = 1000 * RATE, 60, 2
LEFT, RIGHT = Point(-6.0, -6.0, 0.0), Point(6.0, 6.0, 0.0)  # of shard 0, of shard 1


class CrowdShards(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder, cls.processes, cls.tick = tempfile.mkdtemp(), {}, FIRST
        cls.start('/whole/agent_crowd', 0, 1)
        for index in range(SHARDS):
            cls.start_shard(index)
        cls.clock = SimulatedClock()
        cls.clock.wait_for_listeners(SHARDS + 2)  # this process too
        cls.agents, cls.whole = Log('/agents', AgentStates), Log('/whole/agents', AgentStates)
        cls.parts = Log('/agents/parts', CrowdPart)
        for log in (cls.agents, cls.whole, cls.parts):
            wait_for(log.connected, log.topic)
        wait_for(lambda: all(listens('/crowd_%d' % i, '/agents/border') for i in range(SHARDS)), 'borders')
        wait_for(lambda: listens('/crowd_0', '/agents/parts'), 'parts')

    @classmethod
    def tearDownClass(cls):
        for process in cls.processes.values():
            stop(process, signal.SIGKILL)
        shutil.rmtree(cls.folder)

    @classmethod
    def start(cls, name, index, count, **more):
        cls.processes[name] = start_node('agent_crowd', name, {}, scenario=SCENE, frame_wait=10.0, tf_budget=0,
                                         shard=dict(index=index, count=count, wait=2.0), **more)

    @classmethod
    def start_shard(cls, index):
        cls.start('/crowd_%d' % index, index, SHARDS, snapshot_folder=cls.folder, checkpoint_period=0.5,
                  checkpoint=True)

    def run_ticks(self, ticks):
        for _ in range(ticks):
            type(self).tick += 1
            stamp = time_of(self.tick)
            self.clock.set(stamp + rospy.Duration(0.5 / RATE))
            for log in (self.agents, self.whole):
                log.wait_for_stamp(stamp)

    def check_equal(self, first):
        """All people have been the same at the ticks from `first` on."""
        whole = {m.header.stamp: m for m in self.whole.messages}
        checked = [m for m in self.agents.messages if m.header.stamp >= time_of(first)]
        self.assertGreaterEqual(len(checked), self.tick - first)
        for message in checked:
            self.assertEqual(message.hash, whole[message.header.stamp].hash, message.header.stamp)
            self.assertEqual(message.agents, whole[message.header.stamp].agents)
            self.assertEqual([agent.id for agent in message.agents], list(range(PEOPLE)))

    def test_1_are_one_crowd(self):
        self.run_ticks(400)
        self.check_equal(FIRST + 1)
        self.assertGreater(len({m.hash for m in self.agents.messages}), 390)
        at_first = {agent.id for agent in self.parts.messages[0].people.agents}
        since = {agent.id for m in self.parts.messages for agent in m.people.agents}
        still = {agent.id for agent in self.parts.messages[-1].people.agents}
        self.assertGreater(len(since - at_first), 10)  # have come
        self.assertGreater(len(at_first - still), 5)   # have gone

    def test_2_a_killed_shard_continues(self):
        for index in (1, 0):
            first = self.tick + 1
            stop(self.processes['/crowd_%d' % index], signal.SIGKILL)
            self.start_shard(index)
            name = '/crowd_%d' % index
            rospy.wait_for_service(name + '/tf2_frames', DEADLINE)
            for reader, topic in ((name, '/clock'), ('/crowd_0', '/agents/border'), ('/crowd_1', '/agents/border'),
                                  ('/crowd_0', '/agents/parts')):
                wait_for(lambda r=reader, t=topic: listens(r, t), topic)
            wait_for(self.agents.connected, '/agents')
            self.run_ticks(60)
            self.check_equal(first)

    def test_2_markers_of_all_are_on_one_topic(self):
        markers = Log('/agents/markers', MarkerArray)
        wait_for(markers.connected, markers.topic)
        self.run_ticks(30)
        drawn = markers.wait(lambda all: {m.ns: len(m.points) for array in all for m in array.markers
                                          if len(all) > SHARDS}, 'markers')
        markers.close()
        self.assertEqual(set(drawn), {'people_0', 'people_1'})
        self.assertTrue(all(drawn.values()), drawn)

    def ask(self, shard, name, service_type, **request):
        service = '/crowd_%d/%s' % (shard, name)
        rospy.wait_for_service(service, DEADLINE)
        return rospy.ServiceProxy(service, service_type)(**request)

    def test_3_requests_reach_the_owner(self):
        header = Header(frame_id='map')
        ids = []
        for place in (LEFT, RIGHT):
            answer = wait_for(lambda p=place: self.answered(0, 'spawn', SpawnAgents, header=header, count=1,
                                                            like=AgentSpawn(position=p, stands=True)), 'spawn')
            ids.append(answer.ids[0])
        self.assertEqual(len(set(ids)), 2)
        self.assertTrue(all(id_ >= PEOPLE for id_ in ids), ids)
        self.run_ticks(3)
        there = {agent.id: agent for agent in self.agents.messages[-1].agents}
        self.assertLess(there[ids[0]].pose.position.x, 0.0)
        self.assertGreater(there[ids[1]].pose.position.x, 0.0)
        goal = PointStamped(header=header, point=Point(0.0, 0.0, 0.0))
        for shard in range(SHARDS):
            for id_ in ids:
                answer = self.ask(shard, 'set_goal', SetAgentGoal, ids=[id_], goal=goal)
                self.assertTrue(answer.success, answer.message)
        self.run_ticks(3)
        there = {agent.id: agent for agent in self.agents.messages[-1].agents}
        self.assertEqual([there[id_].goal for id_ in ids], [goal.point] * 2)
        for shard, id_ in enumerate(ids[::-1]):
            self.assertTrue(self.ask(shard, 'remove', RemoveAgents, ids=[id_]).success)
        self.run_ticks(3)
        self.assertFalse(set(ids) & {agent.id for agent in self.agents.messages[-1].agents})
        answer = self.ask(1, 'remove', RemoveAgents, ids=[77777])
        self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.UNKNOWN))
        self.assertIn('walker 77777 is unknown', answer.message)

    def answered(self, *request, **fields):
        answer = self.ask(*request, **fields)
        return answer if answer.success else None

    def spawn_both(self):
        """Spawns a person in each shard, and returns both ids."""
        header = Header(frame_id='map')
        return [self.ask(0, 'spawn', SpawnAgents, header=header, count=1,
                         like=AgentSpawn(position=place, stands=True)).ids[0] for place in (LEFT, RIGHT)]

    def people(self):
        return {agent.id: agent for agent in self.agents.messages[-1].agents}

    def test_4_a_request_may_be_for_people_of_both(self):
        ids = self.spawn_both()
        self.run_ticks(2)
        goal = PointStamped(header=Header(frame_id='map'), point=Point(1.0, 1.0, 0.0))
        for shard in range(SHARDS):
            goal.point.x += 1.0
            answer = self.ask(shard, 'set_goal', SetAgentGoal, ids=ids, goal=goal)
            self.assertTrue(answer.success, answer.message)
            self.run_ticks(2)
            self.assertEqual([self.people()[id_].goal for id_ in ids], [goal.point] * 2)
            # One that is unknown refuses it for all.
            answer = self.ask(shard, 'remove', RemoveAgents, ids=ids + [77777])
            self.assertEqual((answer.success, answer.error_code, answer.message),
                             (False, ErrorCode.UNKNOWN, 'ids: walker 77777 is unknown'))
            self.run_ticks(2)
            self.assertTrue(set(ids) <= set(self.people()))
        answer = self.ask(1, 'remove', RemoveAgents, ids=ids)
        self.assertTrue(answer.success, answer.message)
        self.run_ticks(2)
        self.assertFalse(set(ids) & set(self.people()))
        answer = self.ask(0, 'remove', RemoveAgents, all=True)
        self.assertTrue(answer.success, answer.message)
        self.run_ticks(2)
        self.assertFalse(self.people())

    def test_5_a_reset_is_that_of_one_node(self):
        for round_ in range(2):
            for service in ('/crowd_%d/reset' % round_, '/whole/agent_crowd/reset'):
                answer = rospy.ServiceProxy(service, Trigger)()
                self.assertTrue(answer.success, answer.message)
            first = self.tick + 1
            self.run_ticks(200)
            self.check_equal(first)

    def test_6_false_messages_change_nothing(self):
        parts, borders = publisher('/agents/parts', CrowdPart), publisher('/agents/border', CrowdBorder)
        wait_for(lambda: parts.get_num_connections() >= 1 and borders.get_num_connections() >= SHARDS, 'readers')
        first = self.tick + 1
        for ahead in (1, 2, 3, 50, 10 ** 6):
            part = CrowdPart(shard=1)
            part.people.header.frame_id = 'map'
            part.people.header.stamp = time_of(self.tick + ahead)
            parts.publish(part)
            borders.publish(CrowdBorder(header=part.people.header, shard=1, shards=SHARDS, border=b'?'))
        part.people.header = Header(stamp=time_of(self.tick + 1), frame_id='odom')
        parts.publish(part)
        wait_for(all_delivered, 'the messages to arrive')
        self.run_ticks(10)
        parts.unregister()
        borders.unregister()
        self.assertEqual([m.header.stamp for m in self.agents.messages[-10:]],
                         [time_of(first + i) for i in range(10)])
        self.run_ticks(60)
        self.assertEqual(sorted(self.people()), list(range(PEOPLE)))
        self.check_equal(first)

    def test_7_the_clock_jumps_back(self):
        type(self).tick = FIRST - 300
        for log in (self.agents, self.whole, self.parts):
            log.messages.clear()
        first = self.tick + 1
        self.run_ticks(200)
        self.check_equal(first)

    def test_8_a_silent_shard_is_named(self):
        ids = self.spawn_both()
        self.run_ticks(2)
        stop(self.processes['/crowd_1'], signal.SIGKILL)
        for request in (dict(all=True), dict(ids=ids), dict(ids=ids[1:])):
            answer = self.ask(0, 'remove', RemoveAgents, **request)
            self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.NOT_AVAILABLE), answer.message)
            self.assertIn('shard 1 of 2, /crowd_1', answer.message)
        answer = self.ask(0, 'remove', RemoveAgents, ids=ids[:1])
        self.assertTrue(answer.success, answer.message)
        # Those who come to it stand at its border, and `agents` has them.
        for _ in range(90):
            type(self).tick += 1
            self.clock.set(time_of(self.tick) + rospy.Duration(0.5 / RATE))
            self.whole.wait_for_stamp(time_of(self.tick))
        self.agents.wait_for_stamp(time_of(self.tick))
        self.assertEqual(sorted(set(self.people()) - {ids[1]}), list(range(PEOPLE)))

    def test_9_other_people_are_refused(self):
        other = os.path.join(self.folder, 'other.yaml')
        with open(SCENE, encoding='utf-8') as scene, open(other, 'w', encoding='utf-8') as copy:
            copy.write(scene.read().replace('count: 60', 'count: 61'))
        process = start_node('agent_crowd', '/crowd_other', {}, scenario=other, tf_budget=0,
                             shard=dict(index=1, count=SHARDS))
        self.processes['/crowd_other'] = process
        self.assertNotEqual(process.wait(DEADLINE), 0)


if __name__ == '__main__':
    rospy.init_node('crowd_shards_test')
    rostest.rosrun('vegetation_sim', 'crowd_shards', CrowdShards)
