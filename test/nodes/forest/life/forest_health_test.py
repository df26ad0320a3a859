#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Diagnostics of forest_animator report each problem once. A fresh start is the same whatever its
cause."""
import copy
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from std_srvs.srv import Trigger
from vegetation_sim.msg import ForestEvent, WindField

from forest_rig import RATE, Animator, TickClock, ViewerClient, scene, start_animator, stop, time_of
from waiting import wait_for
from watched_node import Log, publisher


class ForestHealth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest = Animator()
        cls.clock = TickClock(100000 * RATE)
        cls.clock.begin(cls.forest)
        cls.diagnostics = Log('/diagnostics', DiagnosticArray)
        wait_for(cls.diagnostics.connected, 'diagnostics')

    def statuses(self, animator):
        name = animator.name.lstrip('/') + ': forest'
        return [s for m in list(self.diagnostics.messages) for s in m.status if s.name == name]

    def expect_reported_once(self, animator, count, text, key):
        """Expects one report with the warning, and then a report that is OK and still has the
        total."""
        def find(level, words, begin):
            def found(_):
                for i, status in list(enumerate(self.statuses(animator)))[begin:]:
                    if status.level == level and words in status.message:
                        return i + 1
                return 0
            return self.diagnostics.wait(found, words)
        warned = find(DiagnosticStatus.WARN, text, self.before)
        well = find(DiagnosticStatus.OK, 'running', warned)
        values = {v.key: float(v.value) for v in self.statuses(animator)[well - 1].values}
        self.assertGreaterEqual(values[key], count)

    def mark(self, animator):
        self.before = len(self.statuses(animator))

    def test_a_rejection_is_reported_once(self):
        self.mark(self.forest)
        viewer = ViewerClient()
        bad = copy.deepcopy(viewer.message)
        bad.height = 0
        viewer.send(bad, self.forest)
        self.expect_reported_once(self.forest, 1, '1 refused input: ', 'Inputs refused')
        viewer.close()

    def test_dropped_ticks_are_reported_once(self):
        self.mark(self.forest)
        self.clock.show(self.clock.tick + 100 * RATE)
        self.forest.state.wait_for_stamp(time_of(self.clock.tick))
        count = 100 * RATE - 1
        self.expect_reported_once(self.forest, count, '%d ticks dropped' % count, 'Ticks dropped')

    # Two nodes that both publish the wind would take turns.
    def test_a_second_publisher_of_the_wind_is_reported_while_it_is_there(self):
        def wait_for_status(level, words):
            self.diagnostics.wait(lambda _: any(
                s.level == level and words in s.message
                for s in self.statuses(self.forest)[self.before:]), words)
        self.mark(self.forest)
        rival = rospy.Publisher('/wind', WindField, queue_size=1, latch=True)
        wait_for_status(DiagnosticStatus.WARN, '2 publishers of /wind: the last message wins')
        rival.unregister()
        self.mark(self.forest)
        wait_for_status(DiagnosticStatus.OK, 'running')

    # After a jump back and after ~reset no frames are sent.
    def test_a_fresh_start_stops_frames(self):
        self.assertEqual(self.forest.set_tf(1, [0, 1], True).frames, 2)
        self.mark(self.forest)
        self.clock.show(self.clock.tick - 5 * RATE)
        self.forest.state.wait_for_stamp(time_of(self.clock.tick))
        self.assertEqual(self.forest.set_tf(1, [2], True).frames, 1)
        self.expect_reported_once(self.forest, 1, '1 jumps back of the clock', 'Clock jumps back')
        self.assertTrue(rospy.ServiceProxy('/forest_animator/reset', Trigger)().success)
        self.clock.run(1, self.forest)
        self.assertEqual(self.forest.set_tf(1, [3], True).frames, 1)
        self.forest.set_tf(1, 'all', False)

    # N6: a replay that differs from its run reports it.
    def test_late_events_of_a_replay_are_reported(self):
        process = start_animator('/replay/forest_animator', {'wind': '/wind'},
                                 scenario=scene('grove'), replay=True, replay_delay=0.0)
        again = Animator('/replay/forest_animator', '/replay/')
        events = publisher('/replay/forest/events', ForestEvent)
        try:
            again.wait_until_up('/replay/forest/events')
            wait_for(lambda: events.get_num_connections() > 1, 'the node, besides our own log')
            self.clock.run(RATE, again)
            self.mark(again)
            for ticks in (1, -3):
                event = ForestEvent(kind=ForestEvent.RESET)
                event.header.stamp = time_of(self.clock.tick + ticks)
                events.publish(event)
                again.settle()
            self.clock.run(2, again)
            self.expect_reported_once(again, 1, '1 recorded events late', 'Recorded events late')
        finally:
            stop(process)
            again.close()


if __name__ == '__main__':
    rospy.init_node('forest_health_test')
    rostest.rosrun('vegetation_sim', 'forest_health', ForestHealth)
