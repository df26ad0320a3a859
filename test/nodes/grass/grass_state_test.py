#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the topics of grass_field: layout, trodden ground, events, cover map and markers, as
program and as nodelet."""
import unittest

import rospy
import rostest
from nav_msgs.msg import OccupancyGrid
from vegetation_sim.msg import GrassCover, GrassEvent, TreadEvent
from visualization_msgs.msg import Marker, MarkerArray

from forest_rig import TickClock, ViewerClient
from grass_rig import FULL, RATE, Feet, Meadow, nodes_of, step, time_of
from waiting import wait_for
from watched_node import Log

LAYERS = ('crush', 'density', 'resistance', 'age', 'cut')


class GrassState(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.grass = Meadow()
        cls.nodelet = Meadow('/twin/grass_field', '/twin/')
        cls.nodelet.process = '/manager'
        cls.clock = TickClock(1000 * RATE)
        for meadow in (cls.grass, cls.nodelet):
            meadow.wait_until_up()
        cls.feet = Feet(cls.grass, readers=2)
        cls.clock.run(1, cls.grass, cls.nodelet)

    def run_both(self, ticks):
        self.clock.run(ticks, self.grass, self.nodelet)

    def fresh_covers(self, logs):
        """Returns the first maps with a stamp after now, one of each log."""
        now = time_of(self.clock.tick)

        def first(log):
            return next((m for m in log.messages if m.header.stamp > now), None)

        def goes_on():
            self.run_both(RATE // 3)
        for log in logs.values():
            log.wait(lambda _, log=log: first(log), 'a map', goes_on)
        maps = {name: first(log) for name, log in logs.items()}
        self.assertEqual(len({m.header.stamp for m in maps.values()}), 1)
        return maps

    # S2-03, S2-W2: one latched message has the whole meadow with images and species.
    def test_the_layout_holds_the_meadow(self):
        layout = self.grass.layout.wait(lambda all: all and all[-1], 'the layout')
        self.assertEqual(layout.header.frame_id, 'map')
        self.assertEqual((layout.columns, layout.rows, layout.resolution), (21, 21, 2.0))
        self.assertEqual([s.name for s in layout.species], ['fescue', 'poppy'])
        self.assertEqual(len(layout.density.samples), 21 * 21)
        self.assertEqual(layout.tread_spacing, 0.05)
        nodelet = self.nodelet.layout.wait(lambda all: all and all[-1], 'the layout of the nodelet')
        self.assertEqual(layout.hash, nodelet.hash)
        self.assertEqual(layout.hash, self.grass.state.messages[-1].layout_hash)

    # S2-22, S2-28, N6: key frames and deltas give the same state, and so do program and nodelet.
    def test_deltas_add_up_to_the_next_key_frame(self):
        self.feet.walk(self.clock, 'a', (-8.0, -5.0), (-3.0, -4.0), 3 * RATE, self.nodelet)
        messages = self.grass.state.messages
        keys = [i for i, m in enumerate(messages) if m.key_frame]
        self.assertGreaterEqual(len(keys), 2)
        held = nodes_of(messages[keys[0]])
        count = 0
        for message in messages[keys[0] + 1:keys[-1]]:
            if message.key_frame:
                continue
            count += len(nodes_of(message))
            held.update(nodes_of(message))
        key = nodes_of(messages[keys[-1]])
        held.update({place: node for place, node in key.items()
                     if node[3] == messages[keys[-1]].header.stamp})
        self.assertGreater(count, 1000)
        self.assertEqual(held, key)
        sequences = [m.sequence for m in messages]
        self.assertEqual(sequences, list(range(sequences[0], sequences[0] + len(sequences))))
        self.run_both(2 * RATE)
        ours, theirs = self.grass.hashes(), self.nodelet.hashes()
        common = sorted(set(ours) & set(theirs))
        self.assertGreater(len(common), 1)
        self.assertEqual([ours[s] for s in common], [theirs[s] for s in common])
        self.assertGreater(len(set(ours.values())), 1)

    # S2-28: at any requested stamp the recovery follows the closed form of the tread's stamps.
    def test_grass_rises_again_in_ros_time(self):
        self.feet.walk(self.clock, 'b', (2.0, 2.0), (4.0, 2.0), RATE, law={'recovery': 20.0})
        self.feet.send(step('b', 0.0, 0.0, action=TreadEvent.LIFT))
        self.clock.run(1, self.grass)
        pressed = time_of(self.clock.tick) - rospy.Duration(self.grass.at(3.0, 2.0).age)
        for age, share in ((0.0, 1.0), (5.0, 0.84375), (10.0, 0.5), (15.0, 0.15625), (20.0, 0.0)):
            stamp = pressed + rospy.Duration(age)
            if stamp < time_of(self.clock.tick):
                continue
            self.assertAlmostEqual(self.grass.at(3.0, 2.0, stamp).tilt, FULL * share, delta=2e-3)

    # N4: events report which source entered which tile, and every accepted input.
    def test_events_report_sources_and_tiles(self):
        self.feet.walk(self.clock, 'mower', (-19.0, 9.0), (-13.0, 9.0), 2 * RATE)

        def treads():
            return [e for e in self.grass.events.messages
                    if e.kind == GrassEvent.TREAD and e.tread.source == 'mower']
        wait_for(lambda: len(treads()) >= 2 * RATE + 1, 'the treads')
        self.assertEqual(self.grass.entered('mower'), [(0, 14), (1, 14), (2, 14), (3, 14)])
        self.assertEqual(len(treads()), 2 * RATE + 1)
        first = treads()[0]
        self.assertEqual(first.tread.law.radius, 0.12)  # No field is left at its default.
        self.assertEqual(first.tread.height_gate, 0.3)
        self.assertEqual(first.header.frame_id, 'map')

    # N5: the values at the centre of a cell are those of a sample.
    def expect_values(self, values, grid):
        self.assertEqual((values.header.frame_id, values.info), ('map', grid))
        for x, y in ((6.125, -8.125), (-6.125, -8.125)):
            cell = int((y + 20.0) / 0.25) * 160 + int((x + 20.0) / 0.25)
            sample = self.grass.at(x, y)
            for name in ('density', 'height', 'crush', 'resistance', 'age'):
                self.assertAlmostEqual(getattr(values, name)[cell], getattr(sample, name), places=4)
        track = int((-9.9 + 20.0) / 0.25) * 160 + int((6.0 + 20.0) / 0.25)
        self.assertGreater(values.crush[track], 0.6)
        self.assertLess(values.resistance[track], 20.0)
        self.assertGreaterEqual(values.age[track], 0.0)

    def test_treads_of_a_tick_do_not_depend_on_the_order_of_their_arrival(self):
        stamp = time_of(self.clock.tick + 5)
        for source, x in (('late', 4.0), ('early', 4.1), ('late', 4.2), ('middle', 4.3)):
            message = step(source, x, 4.0)
            message.header.stamp, message.header.frame_id = stamp, 'map'
            self.feet.send(message)
        self.clock.run(6, self.grass)

        def treads():
            return [(e.tread.source, e.tread.position.x) for e in self.grass.events.messages
                    if e.kind == GrassEvent.TREAD and e.header.stamp == stamp]
        wait_for(lambda: len(treads()) == 4, 'the treads')
        self.assertEqual(treads(), [('early', 4.1), ('late', 4.0), ('late', 4.2), ('middle', 4.3)])

    # N5: cells under the path are set, and they return to zero when the grass has risen.
    def test_the_cover_map_shows_the_track_and_forgets_it(self):
        logs = {name: Log('/grass/cover/' + name, OccupancyGrid) for name in LAYERS}
        logs['plain'] = Log('/grass/cover', OccupancyGrid)
        logs['values'] = Log('/grass/cover/values', GrassCover)
        for log in logs.values():
            wait_for(log.connected, log.topic)
        self.feet.walk(self.clock, 'c', (4.0, -10.0), (8.0, -10.0), 2 * RATE, law={'recovery': 5.0})
        self.feet.send(step('c', 0.0, 0.0, action=TreadEvent.LIFT))
        maps = self.fresh_covers(logs)
        grid = maps['crush'].info
        self.assertEqual((grid.width, grid.height, grid.resolution), (160, 160, 0.25))
        self.assertEqual((grid.origin.position.x, grid.origin.position.y), (-20.0, -20.0))
        self.assertEqual(maps['crush'].header.frame_id, 'map')

        def cell(layer, x, y):
            return maps[layer].data[int((y + 20.0) / 0.25) * 160 + int((x + 20.0) / 0.25)]
        self.assertGreater(cell('crush', 6.0, -9.9), 60)
        self.assertEqual(cell('crush', 6.0, -8.0), 0)
        # In percent of 1000 blades per m^2 and of 100 N s/m, whatever is densest on the map.
        self.assertEqual(cell('density', 6.0, -8.0), 80)
        self.assertEqual(cell('density', -6.0, -8.0), 40)
        self.assertEqual(cell('resistance', 6.0, -8.0), 48)
        self.assertLess(cell('resistance', 6.0, -9.9), 20)
        self.assertEqual(cell('age', 6.0, -8.0), -1)
        self.assertIn(cell('age', 6.0, -9.9), (0, 1))
        self.expect_values(maps['values'], grid)
        self.assertEqual(maps['plain'].info, grid)
        self.assertEqual(maps['plain'].data[:2], maps['crush'].data[:2])
        self.run_both(6 * RATE)
        maps = self.fresh_covers(logs)
        self.assertEqual(cell('crush', 6.0, -9.9), 0)
        self.assertEqual(cell('age', 6.0, -9.9), -1)
        for log in logs.values():
            log.close()

    # S2-08, S2-13: each list is empty or has a constant size, ids do not change, and blades are
    # drawn where a viewer looks.
    def test_markers_keep_their_size_and_ids(self):
        log = Log('/grass/markers', MarkerArray)
        wait_for(log.connected, log.topic)
        viewer = ViewerClient()

        def points():
            return [(p.x, p.y, p.z) for p in log.messages[-1].markers[2].points] if log.messages else []
        for x in (-10.0, 0.0, 5.0):
            def move_viewer():
                viewer.move_to(x, 0.0, 1.0, self.grass)
                self.run_both(6)
            log.wait(lambda _: len({p for p in points() if x < p[0] < x + 8.0}) > 3000,
                     'blades', move_viewer)
        def sizes(array):
            return {(m.ns, m.id, m.action, len(m.points), len(m.colors)) for m in array.markers}
        lists = (('ground', 0), ('strips', 1), ('blades', 2))
        full = {(ns, key, Marker.ADD, 30000, 30000) for ns, key in lists}
        # a list without anything to draw
        gone = {(ns, key, Marker.DELETE, 0, 0) for ns, key in lists}
        for array in log.messages:
            self.assertLessEqual(sizes(array), full | gone)
        self.assertEqual(sizes(log.messages[-1]), full)
        blades = points()
        near = [p for p in blades if 4.0 < p[0] < 20.0]
        self.assertGreater(len(near), 0.7 * len(blades))
        self.assertLess(max(p[2] for p in blades), 0.5)
        log.close()
        viewer.close()


if __name__ == '__main__':
    rospy.init_node('grass_state_test')
    rostest.rosrun('vegetation_sim', 'grass_state', GrassState)
