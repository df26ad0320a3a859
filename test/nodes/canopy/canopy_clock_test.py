#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests canopy_animator while the clock jumps back, jumps ahead and stops, and replays its run
(N6)."""
import unittest

import rospy
import rostest
from std_srvs.srv import Trigger
from vegetation_sim.msg import CanopyEvent

from canopy_rig import Leaves, start_leaves
from forest_rig import RATE, TickClock, ViewerClient, scene, stop, time_of
from waiting import wait_for
from watched_node import publisher

BEGIN = 1000 * RATE
DELAY = 0.5  # [s]


class CanopyClockTest(unittest.TestCase):
    def setUp(self):
        self.leaves, self.clock = Leaves(), TickClock(BEGIN)
        self.leaves.wait_until_up('/wind')

    def tearDown(self):
        self.leaves.close()

    # N6: after a jump back by one second the node has the state of a node that starts at that time.
    def test_time_going_back_is_a_fresh_start(self):
        self.clock.begin(self.leaves)
        self.clock.run(2 * RATE, self.leaves)
        start, earlier = self.clock.tick - RATE, self.newest_wind().wind_hash
        self.go_back(start)
        self.clock.run_until(lambda: self.newest_wind().wind_hash != earlier,
                             'a wind that begins there too', self.leaves)
        self.clock.run(RATE, self.leaves)  # Steps back of up to 0.1 s are no jumps.
        passes = []
        for _ in range(2):
            jumps = self.leaves.diagnostics()['Clock jumps back']
            wind = self.newest_wind()
            fresh = self.go_back(start)
            self.assertEqual(self.leaves.diagnostics()['Clock jumps back'], jumps + 1)
            wait_for(lambda: self.newest_wind().header.stamp == fresh, 'the republished wind')
            self.assertEqual(self.newest_wind().wind_hash, wind.wind_hash)
            self.clock.run(2 * RATE, self.leaves)
            end = self.leaves.state.messages[-1]
            passes.append((end.header.stamp, end.right, end.up, end.depth))
        self.assertEqual(passes[0], passes[1])

    def go_back(self, tick):
        """Returns the stamp of the first state after the jump."""
        self.clock.show(tick)
        self.leaves.state.wait(lambda all: all[-1].sequence == 1, 'a fresh start',
                               lambda: self.clock.show(tick))
        return self.leaves.state.messages[-1].header.stamp

    # Recorded events, the wind and the clock give the same state to the bit, although the replay
    # has already ticked for half a second with another viewer when the run begins. This test must
    # run first, before the clock starts; its name is the first in alphabetical order.
    def test_a_run_replays_from_its_first_tick(self):
        process = start_leaves('/replay/canopy_animator', {'wind': '/wind'}, replay=True,
                               scenario=scene('shrubs'), replay_delay=DELAY)
        try:
            again, viewer = Leaves('/replay/canopy_animator', '/replay/'), ViewerClient('eye')
            again.expect_replay()
            self.recorded = publisher('/replay/canopy/events', CanopyEvent)
            again.wait_until_up('/wind', '/replay/canopy/events')
            wait_for(lambda: self.recorded.get_num_connections() >= 2, 'the replay, and its log')
            self.record(again, [self.earlier_eye()])
            sent = 0
            for tick in range(5 * RATE):
                if tick % 20 == 10:
                    viewer.move_to(-6.0 + 0.02 * tick, 0.5, 1.5, self.leaves)
                self.clock.run(1, self.leaves)
                count = len(self.leaves.events.messages)
                self.record(again, self.leaves.events.messages[sent:count])
                sent = count
            refused = rospy.ServiceProxy('/replay/canopy_animator/reset', Trigger)()
            self.assertIn('follows its recorded events only', refused.message)
            self.assertIn(1.0, [m.eye.position.x for m in again.state.messages])
            self.expect_beginning()
            live, replayed = self.leaves.hashes(), again.hashes()
            common = sorted(set(live) & set(replayed))
            self.assertEqual(common[0], time_of(BEGIN + RATE))
            self.assertGreaterEqual(len(common), 4)
            self.assertEqual([s for s in common if replayed[s] != live[s]], [])
            again.close()
            viewer.close()
        finally:
            stop(process)

    def newest_wind(self):
        return [e for e in self.leaves.events.messages if e.kind == CanopyEvent.WIND][-1]

    def earlier_eye(self):
        event = CanopyEvent(kind=CanopyEvent.VIEWER)
        event.header.stamp = time_of(BEGIN - 5)
        event.eye.position.x, event.eye.orientation.w = 1.0, 1.0
        return event

    def record(self, again, events):
        """Publishes events in time, as the player of a bag does."""
        for event in events:
            self.recorded.publish(event)
        again.settle()

    def expect_beginning(self):
        events = self.leaves.events.messages
        self.assertEqual([e.kind for e in events[:4]],
                         [CanopyEvent.RESET, CanopyEvent.VIEWER, CanopyEvent.SETTINGS, CanopyEvent.WIND])
        self.assertEqual({e.header.stamp for e in events[:4]}, {time_of(BEGIN + 1)})
        self.assertIn(CanopyEvent.WIND, [e.kind for e in events[4:]])


if __name__ == '__main__':
    rospy.init_node('canopy_clock_test')
    rostest.rosrun('vegetation_sim', 'canopy_clock', CanopyClockTest)
