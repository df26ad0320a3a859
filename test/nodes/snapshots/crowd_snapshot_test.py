#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and checkpoints of agent_crowd: walkers, those to come, grass in force."""
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Header
from vegetation_sim.msg import AgentSpawn, CrowdEvent

from crowd_rig import Crowd, at
from forest_rig import time_of
from snapshot_rig import START, RunningNode, SnapshotCase
from waiting import wait_for
from watched_node import all_delivered, publisher


def cover(seed):
    out = OccupancyGrid()
    out.header.frame_id = 'map'
    out.info.width = out.info.height = 20
    out.info.resolution = 1.0
    out.info.origin.position.x = out.info.origin.position.y = -10.0
    out.data = [(seed * i) % 100 for i in range(400)]
    return out


class CrowdSnapshot(SnapshotCase):
    PROGRAM = 'agent_crowd'
    SCENE, OTHER_SCENE = 'crowd', 'garden'
    TOPICS = 'grass/cover/resistance',

    def make_client(self, name, namespace):
        return Crowd(name, namespace)

    def prepare(self, node):
        topic = node.namespace + 'grass/cover/resistance'
        node.covers = publisher(topic, OccupancyGrid)
        wait_for(lambda: node.covers.get_num_connections() == 1, 'the reader of ' + topic)

    def act(self, node, tick):
        crowd = node.client
        if tick == 5:
            self.assertTrue(
                crowd.spawn(like=AgentSpawn(position=at(3, 3)), count=3, spread=1.0).success)
        if tick in (10, 75):
            node.covers.publish(cover(7 if tick == 10 else 13))
            crowd.settle()
        if tick == 20:
            goal = PointStamped(point=at(6, -6))
            self.assertTrue(crowd.set_goal(ids=[0, 9], goal=goal).success)
        if tick == 30:
            Client(node.name).update_configuration({'pace': 1.3, 'sensor_range': 4.0})
        if tick == 50:  # waits while the state is saved
            header = Header(stamp=time_of(START + 100))
            answer = crowd.spawn(header=header, like=AgentSpawn(position=at(-3, 3)), count=2,
                                 spread=1.0)
            self.assertEqual(list(answer.ids), [11, 12])
        if tick == 101:
            self.assertEqual(len(crowd.agents()), 13)
            self.assertEqual(list(crowd.spawn(like=AgentSpawn(position=at(0, 5)), count=1).ids),
                             [13])
        if tick == 110:
            self.assertTrue(crowd.remove(ids=[2, 11]).success)

    # N6: a replay reads the same file, and the stamps of its state move by the same time.
    def test_a_replay_follows_a_run_that_loads(self):
        live = RunningNode(self, 'live')
        again = RunningNode(self, 'again', remappings={'agents/events': '/live/agents/events'},
                            replay=True)
        self.nodes += [live, again]
        again.client.events.close()
        again.client.events = live.client.events
        live.client.wait_until_up()
        again.client.wait_until_up('/live/agents/events')
        self.run_both(live, again, 30)
        saved = live.save('before')
        self.run_both(live, again, 30)
        loaded = live.load('before')
        self.assertAlmostEqual(loaded.shift, 1.0)
        self.assertEqual(loaded.stamp, live.client.state.messages[-1].header.stamp)
        self.assertNotEqual(loaded.hash, saved.hash, 'the stamps are part of the hash')
        self.run_both(live, again, 60)
        end = time_of(self.clock.tick)
        self.run_both(live, again, 16)  # The replay runs half a second behind.
        again.client.state.wait(lambda all: any(m.header.stamp == end for m in all), 'the end',
                                lambda: self.clock.show(self.clock.tick))
        live.client.expect_event(CrowdEvent.LOAD)
        run, replay = live.client.hashes(), again.client.hashes()
        both = sorted(set(run) & set(replay))
        self.assertGreater(len(both), 100)
        self.assertEqual([s for s in both if run[s] != replay[s]], [])
        self.assertIn('recorded events only', again.refusal('before'))

    def hash_with_awaited_cover(self, namespace, is_sent, is_killed):
        """Returns the hash of a run in which a cover comes at tick 11, and acts at tick 16."""
        node = self.start(namespace, 0, checkpoint=is_killed, frame_wait=0.5, cover_rate=0.1,
                          checkpoint_period=3600.0 if is_killed else 0.0)
        self.clock.run(10, node.client)
        if is_sent:
            message = cover(7)
            message.header.stamp = self.stamp_of(10)
            node.covers.publish(message)
            wait_for(all_delivered, 'the cover')
        self.clock.run(3, node.client)
        if is_killed:
            node.kill()
        for tick in range(14, 31):
            self.finish(node, tick)
        out = node.state_hash()
        node.stop()
        return out

    def test_an_awaited_cover_survives_a_kill(self):
        expected = self.hash_with_awaited_cover('whole', True, False)
        self.assertNotEqual(self.hash_with_awaited_cover('without', False, False), expected)
        self.assertEqual(self.hash_with_awaited_cover('killed', True, True), expected)

    def run_both(self, live, again, ticks):
        """Runs single ticks; before each one the replay has received the events of the one
        before."""
        for _ in range(ticks):
            self.clock.run(1, live.client)
            again.client.settle()


if __name__ == '__main__':
    rospy.init_node('crowd_snapshot_test')
    rostest.rosrun('vegetation_sim', 'crowd_snapshot', CrowdSnapshot)
