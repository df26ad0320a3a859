#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""grass_field bounds and counts its inputs when it receives more treads than it accepts, and
continues."""
import math
import subprocess
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from vegetation_sim.msg import ErrorCode, GrassColour, GrassCut, TreadEvents, TreadLaw

from forest_rig import TickClock, memory_of
from grass_rig import FULL, RATE, Feet, Meadow, step, time_of, wide_stroke
from waiting import wait_for
from watched_node import publisher, wait_for_readers

MOST_WAITING = 10000  # limit of the inputs of one client that may wait for a tick
PER_SECOND = 10000
MOST_OUTLINE = 1000  # points of the outline or the swath of a cut
MOST_POINTS = 1000000  # of all cuts of one client that wait
MOST_LIST = 256  # discs of colour of a request
MOST_DISCS = 25000  # of all requests of one client that wait
MOST_WIDE = 30  # wide strokes across the lawn that press 5e7 nodes, or fewer: the share of a client


class GrassFlood(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.clock = TickClock(1000 * RATE)
        cls.grass.wait_until_up()
        cls.feet = Feet(cls.grass)
        cls.clock.run(1, cls.grass)

    def flood(self, count, prefix='s'):
        """Sends steps of many sources and waits only after every 500 steps until they have been
        received."""
        for first in range(0, count, 500):
            self.feet.send(*[step('%s%d' % (prefix, i % 100), -15.0 + 0.3 * (i % 100),
                                  -15.0 + 0.01 * (i // 100)) for i in range(first, first + 500)])

    # No input is applied while the clock stops. The inputs beyond the limit are dropped and
    # counted.
    def test_1_inputs_beyond_the_limit_are_counted(self):
        self.flood(3 * MOST_WAITING)
        values = self.grass.diagnostics()
        self.assertEqual(values['Inputs lost'], 2 * MOST_WAITING)
        answer = rospy.ServiceProxy('/grass_field/reset', Trigger)()
        self.assertFalse(answer.success)
        self.assertIn('too many inputs wait already', answer.message)
        # Another client has room.
        command = ['rosservice', 'call', '/grass_field/clear', '{}']
        self.assertIn('success: True', subprocess.check_output(command, text=True))
        before = values['Inputs taken']
        self.clock.run(1, self.grass)
        self.assertEqual(self.grass.diagnostics()['Inputs taken'], before + MOST_WAITING + 1)

    # With 10 000 events per second of ROS time all events are applied, and memory does not grow.
    def test_2_ten_thousand_a_second_are_taken(self):
        lost = self.grass.diagnostics()['Inputs lost']
        self.flood(PER_SECOND // RATE * 10)
        self.clock.run(10, self.grass)
        held, taken = memory_of('/grass_field'), self.grass.diagnostics()['Inputs taken']
        sent = 0
        for _ in range(2 * RATE):
            self.flood(500)
            sent += 500
            self.clock.run(1, self.grass)
        values = self.grass.diagnostics()
        self.assertEqual(values['Inputs lost'], lost)
        self.assertEqual(values['Inputs taken'], taken + sent)
        self.assertLess(memory_of('/grass_field') - held, 30e6)

    def test_3_sources_are_bounded_too(self):
        refused = self.grass.diagnostics()['Inputs refused']
        self.feet.send(*[step('n%d' % i, 0.0, 0.0, 9.0) for i in range(5000)])
        self.clock.run(1, self.grass)
        values = self.grass.diagnostics()
        self.assertEqual(values['Sources'], 4096)
        self.assertGreaterEqual(values['Inputs refused'], refused + 5000 - 4096)
        self.clock.run(4 * RATE, self.grass)  # This is longer than the lease of a source.
        self.assertEqual(self.grass.diagnostics()['Sources'], 0)
        self.feet.send(step('late', 10.0, 10.0))
        self.clock.run(1, self.grass)
        self.assertGreater(self.grass.at(10.0, 10.0).tilt, FULL - 1e-3)

    # The points of all requests to cut that wait are bounded, and told with the limit.
    def test_4_points_of_cuts_that_wait_are_bounded(self):
        ring = [Point(0.01 * math.cos(0.001 * math.tau * i), 0.01 * math.sin(0.001 * math.tau * i), 0)
                for i in range(MOST_OUTLINE)]
        header = Header(stamp=time_of(self.clock.tick + 5))
        largest = dict(header=header, cut=GrassCut(outline=ring, swath=ring, height=0.05))
        for _ in range(MOST_POINTS // (2 * MOST_OUTLINE)):
            answer = self.grass.cut(**largest)
            self.assertTrue(answer.success, answer.message)
        one = GrassCut(outline=ring[:1], radius=0.1, height=0.05)
        answer = self.grass.cut(header=header, cut=one)
        self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.NO_ROOM))
        self.assertEqual(answer.message, 'points of cuts that wait = %d with the 1 of this request, '
                         'allowed are 0 to %d' % (MOST_POINTS + 1, MOST_POINTS))
        self.clock.run(6, self.grass)
        answer = self.grass.cut(cut=one)
        self.assertTrue(answer.success, answer.message)

    # One message has more strokes than a tick has time for: their work is bounded in nodes, and
    # those that are refused are counted.
    def test_5_the_work_of_many_strokes_is_bounded(self):
        self.clock.run(1, self.grass)  # nothing waits
        before = self.grass.diagnostics()
        names = ['wide_%05d' % i for i in range(MOST_WAITING)]
        treads = publisher('/treads', TreadEvents)
        wait_for_readers('/treads', '/grass_field')
        treads.publish(TreadEvents(events=[wide_stroke(name, (-20.0, 0.0), (20.0, 0.0))
                                           for name in names]))
        self.grass.settle()
        refused = int(self.grass.diagnostics()['Inputs refused'] - before['Inputs refused'])
        self.assertGreater(refused, MOST_WAITING - MOST_WIDE)
        self.clock.run(1, self.grass)
        after = self.grass.diagnostics()
        self.assertEqual(after['Inputs taken'] - before['Inputs taken'], MOST_WAITING - refused)
        self.assertEqual(after['Inputs lost'], before['Inputs lost'])
        wait_for(lambda: self.grass.trodden('wide_') == names[:MOST_WAITING - refused],
                 'the events of the strokes in their order')
        path = [Point(0.01 * i, 0.0, 0.0) for i in range(1000)]
        law = TreadLaw(has_reach=True, reach=10.0)
        answer = self.grass.tread(points=path, law=law)
        self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.NO_ROOM))
        self.assertIn('nodes of treads and cuts that wait = ', answer.message)
        self.assertTrue(self.grass.tread(points=path[:10], law=law).success)

    # The discs of colour of all requests that wait are bounded too.
    def test_6_discs_that_wait_are_bounded(self):
        self.clock.run(1, self.grass)  # nothing waits
        discs = [GrassColour(radius=1.0)] * MOST_LIST
        taken = MOST_DISCS // MOST_LIST
        for _ in range(taken):
            answer = self.grass.set_colours(colours=discs)
            self.assertTrue(answer.success, answer.message)
        answer = self.grass.set_colours(colours=discs)
        self.assertEqual((answer.success, answer.error_code), (False, ErrorCode.NO_ROOM))
        self.assertEqual(answer.message, 'discs of colour that wait = %d with the %d of this request, '
                         'allowed are 0 to %d' % ((taken + 1) * MOST_LIST, MOST_LIST, MOST_DISCS))
        self.clock.run(1, self.grass)
        answer = self.grass.set_colours(colours=discs)
        self.assertTrue(answer.success, answer.message)


if __name__ == '__main__':
    rospy.init_node('grass_flood_test')
    rostest.rosrun('vegetation_sim', 'grass_flood', GrassFlood)
