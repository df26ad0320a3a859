#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""dynamic_reconfigure changes a meadow while it runs."""
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from vegetation_sim.msg import GrassEvent
from visualization_msgs.msg import MarkerArray

from forest_rig import TickClock, ViewerClient
from grass_rig import FULL, RATE, Feet, Meadow, step
from waiting import wait_for
from watched_node import Log

PLAIN = dict(tread_radius=0.12, tread_reach=0.35, tread_softness=0.1, tread_load=1.0,
             tread_recovery=60.0, height_gate=0.3, drag=0.2, tolerance=1.5, transition=0.5,
             farthest=400.0)


class GrassTuning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.clock = TickClock(1000 * RATE)
        cls.grass.wait_until_up()
        cls.feet = Feet(cls.grass)
        cls.clock.run(1, cls.grass)
        cls.server = Client('/grass_field', timeout=30)

    def setUp(self):
        self.tune(**PLAIN)
        self.grass.clear(all=True)
        self.clock.run(1, self.grass)

    def tune(self, **settings):
        """Changes settings and runs the tick at which they take effect."""
        self.server.update_configuration(settings)
        self.clock.run(1, self.grass)

    def print_at(self, x, y, z=0.0):
        """Makes a footprint with the default law of the node. Returns the sample in its middle."""
        self.feet.send(step('foot', x, y, z))
        self.clock.run(1, self.grass)
        return self.grass.at(x, y)

    def test_the_law_of_treading(self):
        self.tune(tread_radius=0.4, tread_reach=0.8, tread_softness=0.3)
        self.print_at(0.0, 0.0)
        self.assertGreater(self.grass.at(0.35, 0.0).tilt, FULL - 1e-6)
        layout = self.grass.layout.wait(lambda all: all[-1].tread.radius == 0.4 and all[-1], 'a layout')
        self.assertEqual(layout.hash, self.grass.state.messages[-1].layout_hash)
        self.tune(tread_load=0.5)
        self.assertAlmostEqual(self.print_at(5.0, 0.0).tilt, 0.5 * FULL, delta=1e-4)
        self.tune(tread_load=1.0, tread_recovery=1.0)
        self.print_at(10.0, 0.0)
        self.feet.send(step('foot', 0.0, 0.0, 9.0))
        self.clock.run(RATE + 2, self.grass)
        self.assertEqual(self.grass.at(10.0, 0.0).tilt, 0.0)

    def test_the_height_gate(self):
        self.assertEqual(self.print_at(0.0, 5.0, 0.5).tilt, 0.0)
        self.tune(height_gate=0.6)
        self.assertGreater(self.print_at(0.0, 5.0, 0.5).tilt, FULL - 1e-6)

    def test_the_drag(self):
        before = self.grass.at(7.0, 7.0).resistance
        self.tune(drag=0.6)
        self.assertAlmostEqual(self.grass.at(7.0, 7.0).resistance, 3.0 * before)

    # S2-15: the markers follow the settings.
    def test_the_tolerance_of_the_view(self):
        log = Log('/grass/markers', MarkerArray)
        wait_for(log.connected, log.topic)
        viewer = ViewerClient()
        viewer.move_to(-10.0, 0.0, 6.0, self.grass)

        def expect(test, what):
            """Waits until `test` holds for the number of different blade points in the newest
            markers."""
            def goes_on():
                viewer.move_to(-10.0, 0.0, 6.0, self.grass)
                self.clock.run(6, self.grass)
            log.wait(lambda all: all and test(len({(p.x, p.y, p.z)
                                                   for p in all[-1].markers[2].points})), what, goes_on)
        expect(lambda count: count > 3000, 'many blades')
        self.tune(tolerance=100.0, transition=0.0)
        expect(lambda count: count < 1000, 'few blades')
        self.tune(tolerance=1.5)
        expect(lambda count: count > 3000, 'many blades again')
        self.tune(farthest=1.0)
        expect(lambda count: count < 1000, 'no blades as far as that')
        viewer.close()
        log.close()

    def test_wrong_settings_are_rejected_and_events_report_the_others(self):
        refused = self.grass.diagnostics()['Inputs refused']
        settings = self.server.update_configuration({'tread_reach': 0.1})
        self.assertEqual(settings['tread_reach'], 0.35)
        settings = self.server.update_configuration({'drag': float('nan')})
        self.assertEqual(settings['drag'], 0.2)
        self.assertEqual(self.grass.diagnostics()['Inputs refused'], refused + 2)
        self.tune(drag=0.7)
        event = self.grass.events.wait(
            lambda all: next((e for e in all if e.kind == GrassEvent.SETTINGS and 0.7 in e.values), None),
            'the event')
        self.assertEqual(sorted(event.names), sorted(PLAIN))
        self.assertEqual(dict(zip(event.names, event.values))['drag'], 0.7)


if __name__ == '__main__':
    rospy.init_node('grass_tuning_test')
    rostest.rosrun('vegetation_sim', 'grass_tuning', GrassTuning)
