#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests S2-30, S2-36 and the requirements of part 4 for the crowd through the interface of the
node."""
import math
import subprocess
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray
from vegetation_sim.msg import AgentSpawn, CrowdEvent, CrowdView, ForestLayout, ShardNode, TreadEvent

from crowd_rig import Cart, Crowd, at, distance
from forest_rig import TickClock, time_of
from given import given
from waiting import wait_for
from watched_node import Log, publisher

START = 3000  # tick


def goal(x, y):
    message = PointStamped()
    message.point = at(x, y)
    return message


class CrowdRequests(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('crowd_requests_test')
        cls.crowd = Crowd()
        cls.clock = TickClock(START)
        cls.crowd.wait_until_up()
        cls.clock.run(30, cls.crowd)

    def test_1_walks_and_treads(self):
        before = self.crowd.agents()
        self.assertEqual(len(before), 8)
        self.clock.run(60, self.crowd)
        after = self.crowd.agents()
        moved = [distance(before[i].pose.position, after[i].pose.position) for i in before]
        self.assertGreater(sum(moved) / 8, 0.8)  # in 2 s
        for a in after.values():
            self.assertLess(max(abs(a.pose.position.x), abs(a.pose.position.y)), 8.7)
            for b in after.values():
                if a.id < b.id:
                    self.assertGreater(distance(a.pose.position, b.pose.position), 0.5 - 1e-6)
        self.expect_view()
        prints = [t for t in self.crowd.tread_events() if t.action == TreadEvent.STROKE]
        self.assertGreater(len(prints), 16)
        self.assertTrue(all(t.source.startswith('hall/walker_') for t in prints))
        for t in prints:  # A footprint extends from heel to ball.
            self.assertTrue(0.15 < distance(t.start, t.position) < 0.3)

    def expect_view(self):
        """The view has the same walkers at the same ticks within 0.5 mm and 48 urad, to a late
        subscriber as well: each message is complete."""
        late = Log('/agents/view', CrowdView)
        wait_for(late.connected, 'the view')
        self.clock.run(3, self.crowd)
        late.wait_for_stamp(time_of(self.clock.tick))
        full = {m.header.stamp: m for m in self.crowd.state.messages}
        for view in late.messages:
            agents = full[view.header.stamp].agents
            ids = [i for first, count in zip(view.first_id, view.id_count)
                   for i in range(first, first + count)]
            self.assertEqual(ids, [a.id for a in agents])
            for k, agent in enumerate(agents):
                place = at(view.origin_x + 1e-3 * view.x[k], view.origin_y + 1e-3 * view.y[k])
                self.assertLess(distance(place, agent.pose.position), 0.00071)  # the diagonal
                q = agent.pose.orientation
                turn = 2.0 * math.pi / 65536 * view.heading[k] - 2.0 * math.atan2(q.z, q.w)
                self.assertLess(abs(math.remainder(turn, 2.0 * math.pi)), 48e-6)

    def test_2_spawns_sends_and_removes(self):
        answer = self.crowd.spawn(like=AgentSpawn(position=at(5, 6), stands=True), count=2, spread=0.5)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(list(answer.ids), [8, 9])
        self.clock.run(2, self.crowd)
        self.assertEqual(len(self.crowd.agents()), 10)
        self.assertTrue(self.crowd.set_goal(ids=[8], goal=goal(6.5, 7.5)).success)
        self.clock.run(150, self.crowd)
        self.assertTrue(self.crowd.agents()[8].arrived)
        self.assertLess(distance(self.crowd.agents()[8].pose.position, at(6.5, 7.5)), 0.6)
        self.assertTrue(self.crowd.remove(ids=[8, 9]).success)
        self.clock.run(1, self.crowd)
        self.assertEqual(sorted(self.crowd.agents()), list(range(8)))
        for kind in (CrowdEvent.SPAWN, CrowdEvent.GOAL, CrowdEvent.REMOVE):
            self.crowd.expect_event(kind)

    def test_3_invalid_requests_are_rejected(self):
        hash_before = self.crowd.state.messages[-1].hash

        def refusal(answer):
            self.assertFalse(answer.success)
            return answer.message

        nan = float('nan')
        spawn, crowd = self.crowd.spawn, self.crowd
        self.assertIn('like: x = nan', refusal(spawn(like=AgentSpawn(position=at(nan, 0)), count=1)))
        self.assertIn('speed = 40', refusal(spawn(like=AgentSpawn(**given(speed=40.0)), count=1)))
        self.assertIn('speed = 0 m/s is outside 0.1 to 3',
                      refusal(spawn(like=AgentSpawn(**given(speed=0.0)), count=1)))
        for field in ('speed', 'radius', 'height'):
            self.assertIn('like: %s = 1 needs has_%s = true' % (field, field),
                          refusal(spawn(like=AgentSpawn(**{field: 1.0}), count=1)))
        self.assertIn('like: goal needs has_goal = true',
                      refusal(spawn(like=AgentSpawn(goal=at(2, 2)), count=1)))
        self.assertIn('count = 0 is outside 1 to ', refusal(spawn()))
        self.assertIn('count = 100000', refusal(spawn(count=100000)))
        self.assertIn('most_walkers = 50', refusal(spawn(count=60)))
        self.assertIn('walker 77 is unknown', refusal(crowd.remove(ids=[77])))
        self.assertIn('walker 77 is unknown', refusal(crowd.set_goal(ids=[77], goal=goal(0, 5))))
        self.assertIn('no way leads there', refusal(crowd.set_goal(ids=[1], goal=goal(20, 0))))
        self.assertIn('goal: x = nan', refusal(crowd.set_goal(ids=[1], goal=goal(nan, 0))))
        strange = goal(1, 1)
        strange.header.frame_id = 'nowhere'
        self.assertIn("'nowhere'", refusal(crowd.set_goal(ids=[1], goal=strange)))
        self.assertEqual(crowd.state.messages[-1].hash, hash_before)

    def robot_near(self, x, y):
        """Returns the robot as the crowd reports it. The crowd may be one tick behind tf, so ticks
        pass until it arrives."""
        def newest(events):
            robots = [e.robot for e in events if e.kind == CrowdEvent.ROBOT][-1:]
            return robots and distance(robots[0].position, at(x, y)) < 0.06 and robots[0]
        return self.crowd.events.wait(newest, 'the robot', lambda: self.clock.run(1, self.crowd))

    def test_4_robots_live_pose_counts(self):
        cart = Cart(self.crowd)
        speed, nearest = 1.5, 1e9
        for lane in (-1.5, 1.5):
            for i in range(180):
                x = -8.0 + speed * i / 30.0
                if abs(x) < 0.8 or x > 7.9:
                    break
                cart.put(x, lane, time_of(self.clock.tick))
                self.clock.run(1, self.crowd)
                robot = self.robot_near(x, lane)
                for agent in self.crowd.agents().values():
                    gap = distance(agent.pose.position, robot.position) - 0.5 - agent.radius
                    nearest = min(nearest, gap)
        self.assertGreater(nearest, -1e-6)
        self.clock.run(40, self.crowd)  # The frame is no longer published.
        self.crowd.expect_event(CrowdEvent.REMOVE_ROBOT)
        cart.put(float('nan'), 0.0, time_of(self.clock.tick))
        self.clock.run(3, self.crowd)
        self.assertEqual(self.crowd.diagnostics()['Robots'], 0)

    def test_5_frames_are_bounded_and_go_to_walkers_near_robots(self):  # N7
        began = time_of(self.clock.tick)
        log = Log('/tf', TFMessage)
        cart = Cart(self.crowd)

        def come():
            last = self.crowd.agents()[7].pose.position
            cart.put(last.x - 2.0, last.y, time_of(self.clock.tick))
            self.clock.run(1, self.crowd)
        log.wait(lambda all: any(t.child_frame_id == 'hall/walker_7' for m in all for t in m.transforms),
                 'the walker beside the robot', come)
        rounds = [[t for t in m.transforms if t.child_frame_id.startswith('hall/walker_')]
                  for m in log.messages]
        log.close()
        self.assertEqual({len(r) for r in rounds if r}, {3})
        self.clock.run(40, self.crowd)  # The frame is no longer published.
        self.crowd.expect_event(CrowdEvent.REMOVE_ROBOT, lambda e: e.header.stamp > began)

    def test_5_governor_reports_levels_and_reason(self):  # N7
        markers = Log('/agents/markers', MarkerArray)
        markers.wait(len, 'people', lambda: self.clock.run(1, self.crowd))
        values = self.crowd.diagnostics('governor')
        errors = self.crowd.predicted_errors('/agents/errors')
        markers.close()
        # N9: the gap between a circle of 17 cm and ten facets, at 100 pixels a metre.
        drawn = errors['agents/markers']
        self.assertAlmostEqual(drawn.metres, 0.17 * (1.0 - math.cos(math.pi / 10)), places=6)
        self.assertAlmostEqual(drawn.pixels, 100.0 * drawn.metres, places=4)
        self.assertEqual(drawn.cost, values['Cost [points]'])
        # Half a millimetre along three axes, times the leverage of legs that are nearly straight.
        self.assertTrue(0.001 < errors['agents/view'].metres < 0.03, errors['agents/view'])
        # Without a viewer all walkers have the same level.
        self.assertEqual(values['Walkers: of 10 facets'], 8)
        self.assertEqual(values['Walkers that the budget holds back'], 0)
        self.assertEqual(values['Cost [points]'], values['Marker points'])
        self.assertLessEqual(values['Cost [points]'], values['Budget [points]'])
        self.assertEqual(values['tf frames'], 3)

    # A reset keeps the ids that were returned before, and walkers with a future stamp count towards
    # the limit.
    def test_6_future_walkers_keep_their_ids_and_count_towards_the_limit(self):
        later = Header(stamp=time_of(self.clock.tick + 60))
        first = self.crowd.spawn(header=later, like=AgentSpawn(position=at(5, 6)), count=30, spread=2.0)
        self.assertTrue(first.success, first.message)
        refused = self.crowd.spawn(like=AgentSpawn(position=at(5, -6)), count=20)
        self.assertFalse(refused.success)
        self.assertIn('8 of most_walkers = 50 are there, 30 are to come', refused.message)
        self.assertTrue(self.crowd.reset().success)
        self.clock.run(1, self.crowd)
        second = self.crowd.spawn(like=AgentSpawn(position=at(5, -6)), count=1)
        self.assertTrue(second.success, second.message)
        self.clock.run(70, self.crowd)
        self.assertEqual(sorted(self.crowd.agents()), sorted([*range(8), *first.ids, *second.ids]))

    def test_7_reset_and_time_going_back_are_fresh_starts(self):
        self.assertTrue(self.crowd.reset().success)
        self.clock.run(1, self.crowd)
        start = self.crowd.agents()
        self.clock.run(20, self.crowd)
        self.clock.show(START - 1000)
        self.crowd.state.wait_for_stamp(time_of(START - 1000), lambda: self.clock.show(START - 1000))
        again = self.crowd.agents()
        self.assertEqual(sorted(again), sorted(start))
        for i in start:
            self.assertLess(distance(start[i].pose.position, again[i].pose.position), 0.1)
        self.assertGreaterEqual(self.crowd.diagnostics()['Clock jumps back'], 1)

    # Shards of one forest publish equal layouts; two forests would take turns.
    def test_8_a_second_forest_is_reported_but_not_a_second_shard(self):
        words = '2 publishers of /forest/layout: the last message wins'
        reports = Log('/diagnostics', DiagnosticArray)
        wait_for(reports.connected, 'diagnostics')
        first = publisher('/forest/layout', ForestLayout)
        second = subprocess.Popen(['rostopic', 'pub', '/forest/layout', 'vegetation_sim/ForestLayout', '{}'])

        def told(since):
            return [words in status.message for report in reports.messages[since:]
                    for status in report.status if status.name.endswith('agent_crowd: crowd')]
        wait_for(lambda: any(told(0)), words)
        shards = publisher('/forest/shards', ShardNode)
        wait_for(shards.get_num_connections, 'the reader of shards')
        shards.publish(ShardNode(shard=1, shards=2))
        since = len(reports.messages)
        wait_for(lambda: len(told(since)) > 3 and not any(told(since)[-2:]), 'no warning of two shards')
        second.terminate()
        second.wait()
        first.unregister()


if __name__ == '__main__':
    rostest.rosrun('vegetation_sim', 'crowd_requests_test', CrowdRequests)
