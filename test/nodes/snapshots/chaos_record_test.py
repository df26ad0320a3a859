#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The recorder of the chaos test has each event once, whether a message or a journal has it first.
The trend of the memory is that of what a node holds."""
import io
import unittest

import rospy
import rostest
from std_msgs.msg import Header
from vegetation_sim.msg import AgentStates, CanopyState, ForestState, GrassEvent, GrassState

from raw_messages import STATE_HASHES
from recording import NodeRecord
from watches import floors_of, trend_of

TICK = rospy.Time(1000, 0)
OTHER = rospy.Time(1001, 0)


def bytes_of(message):
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


def event_of(source, frame='map', stamp=TICK):
    """Returns the bytes of a message; a journal has no frame."""
    message = GrassEvent(kind=GrassEvent.TREAD)
    message.header.stamp, message.header.frame_id, message.tread.source = stamp, frame, source
    return bytes_of(message)


class ChaosRecord(unittest.TestCase):
    def setUp(self):
        self.record = NodeRecord(GrassEvent, (GrassEvent.ENTER,))
        self.published = [event_of('left'), event_of('right')]
        self.journal = {TICK.to_nsec(): [event_of('left', ''), event_of('right', '')]}

    def expect(self, missing, doubled):
        self.record.complete()
        self.assertEqual(self.record.events[TICK.to_nsec()], self.published)
        self.assertEqual((self.record.missing, self.record.doubled), (missing, doubled))

    # A node writes a tick to its journal before all readers have received the events.
    def test_events_that_arrive_after_the_journal_are_not_doubled(self):
        self.record.add_event(self.published[0])
        self.record.take_journal(self.journal)
        self.record.add_event(self.published[1])
        self.expect(0, 0)

    def test_events_that_never_arrive_are_those_of_the_journal(self):
        self.record.add_event(self.published[1])
        self.record.take_journal(self.journal)
        self.expect(1, 0)

    # A process that was killed has published events of a tick that it did not finish.
    def test_events_that_were_not_applied_are_forgotten(self):
        for raw in (*self.published, event_of('lost', stamp=OTHER)):
            self.record.add_event(raw)
        self.record.end_process(0, self.journal)
        self.expect(0, 1)
        self.assertNotIn(OTHER.to_nsec(), self.record.events)

    def test_the_hash_of_a_state_is_read_from_its_bytes(self):
        header, value = Header(1, TICK, 'map'), 0x123456789ABCDEF0
        bent = dict(bent_plants=[7], bent_cells=[1], lean_x=[-2], lean_y=[3])
        states = {
            'forest_animator': ForestState(header=header, base_blend=[0.1, 0.2, 0.3], hash=value),
            'grass_field': GrassState(header=header, key_frame=True, press_stamps=[TICK], hash=value),
            'canopy_animator': CanopyState(header=header, right=[1] * 5, up=[2] * 5, cut_plants=[4, 5],
                                           cut_heights=[0.5, 0.6], hash=value, **bent),
            'agent_crowd': AgentStates(header=header, hash=value)}
        for node, state in states.items():
            self.assertEqual(STATE_HASHES[node](bytes_of(state)), value, node)

    # Nodes keep some freed memory, and hold more while they are busy than while they rest.
    def test_the_trend_of_memory_is_that_of_its_floor_at_rest(self):
        rests = [(begin, begin + 94.0) for begin in range(0, 1400, 240)]
        for growth in (0.0, 2.0):  # [MB/h]
            samples = [(at, 11.0 + growth * at / 3600.0 + 0.1 * (at % 47) +
                        (0.0 if any(a <= at <= b for a, b in rests) else -0.01 * at))
                       for at in range(0, 1500, 2)]
            trend = trend_of([(at / 3600.0, size) for at, size in floors_of(samples, rests)])
            self.assertAlmostEqual(trend.slope, growth, delta=0.3)
            self.assertLess(trend.error, 0.3)
            self.assertGreater(trend.duration, 1100.0 / 3600.0)


if __name__ == '__main__':
    rospy.init_node('chaos_record_test')
    rostest.rosrun('vegetation_sim', 'chaos_record', ChaosRecord)
