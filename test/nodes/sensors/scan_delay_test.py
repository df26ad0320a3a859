#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A cloud shows people at their positions at its stamp (N1), however far it runs behind the
clock."""
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import Point
from vegetation_sim.msg import AgentSpawn, ScanReport

from crowd_rig import Crowd
from forest_rig import RATE, TickClock, time_of
from scan_rig import Mast, Scanner, cloud_of

START = 1000 * RATE
SPEED = 1.4  # [m/s]
# Only the pelvis is used: the trunk above it leans and turns, and the limbs swing.
PELVIS = 4
UNHIDDEN = 0.18  # [m]; narrower, an arm hides a part of it
CLOSE = 0.04  # [m]; a walker moves 4.7 cm in a tick of the crowd and 14 cm in the delay


class ScanDelay(unittest.TestCase):
    def setUp(self):
        self.crowd, self.scanner = Crowd(), Scanner()
        self.clock = TickClock(START)
        self.scanner.wait_until_up('/agents')
        self.crowd.wait_until_up()
        self.mast = Mast(self.scanner)

    # The scanner's ticks of 50 ms fall between the crowd's ticks of 33 ms.
    def test_a_walker_is_at_its_position_at_the_stamp(self):
        self.clock.run(1, self.crowd)
        walker = AgentSpawn(position=Point(5, -3, 0), heading=numpy.pi / 2, has_speed=True,
                            speed=SPEED, has_goal=True, goal=Point(5, 30, 0))
        answer = self.crowd.spawn(like=walker, count=1)
        self.assertTrue(answer.success, answer.message)
        errors, stamps = [], set()
        while self.clock.tick < START + 4 * RATE:
            self.mast.put(0.0, 0.0, 1.2, time_of(self.clock.tick + 1))
            self.clock.run(1, self.crowd)
            self.crowd.settle()
            self.scanner.settle()
            cloud = self.scanner.points.messages[-1:]
            if not cloud or cloud[0].header.stamp in stamps:
                continue
            stamps.add(cloud[0].header.stamp)
            error = self.error_of(cloud[0])
            if error is not None:
                errors.append(error)
        self.assertGreater(len(errors), 10)
        self.assertLess(numpy.abs(errors).max(), CLOSE, errors)
        self.assertLess(abs(numpy.mean(errors)), CLOSE / 2, errors)

    def error_of(self, message):
        """Returns how far the walker is seen ahead of its position [m], or None if it is not just
        in front, or hidden."""
        stamp = message.header.stamp.to_sec()
        states = [(m.header.stamp.to_sec(), m.agents[0].pose.position)
                for m in self.crowd.state.messages if m.agents]
        place = numpy.interp(stamp, [t for t, _ in states], [p.y for _, p in states])
        points = cloud_of(message)
        pelvis = points[(points['label'] == ScanReport.PERSON) & (points['branch'] == PELVIS)]
        if abs(place) > 1.0 or len(pelvis) < 16 or numpy.ptp(pelvis['y']) < UNHIDDEN:
            return None
        return 0.5 * (pelvis['y'].min() + pelvis['y'].max()) - place


if __name__ == '__main__':
    rospy.init_node('scan_delay_test')
    rostest.rosrun('vegetation_sim', 'scan_delay', ScanDelay)
