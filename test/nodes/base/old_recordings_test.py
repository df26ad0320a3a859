#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A replay of events that another version of the package has recorded is a warning on /diagnostics
and a line on the console, and the node applies events of its own version afterwards."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosgraph_msgs.msg import Log as ConsoleLine
from std_msgs.msg import String
from vegetation_sim.msg import CanopyEvent, CrowdEvent, ForestEvent, GrassEvent

from forest_rig import RATE, TickClock, time_of
from waiting import wait_for
from watched_node import Log, listens, publisher, wait_for_readers

NODES = '/forest_animator', '/grass_field', '/canopy_animator', '/agent_crowd'
OLD_SUM = '0123456789abcdef0123456789abcdef'


def old(event):
    """Returns the type of an event as an earlier version had it."""
    return type('Old', (event,), {'_md5sum': OLD_SUM})


class OldRecordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.reports = Log('/diagnostics', DiagnosticArray)
        cls.console = Log('/rosout', ConsoleLine)
        wait_for_readers('/clock', *NODES)
        for topic in '/rosout', '/diagnostics':
            wait_for(lambda: listens(rospy.get_name(), topic), topic)

    def statuses(self, node):
        return [s for m in list(self.reports.messages) for s in m.status
                if s.name.startswith(node + ': ')]

    def taken(self, node):
        return max([int(pair.value) for s in self.statuses(node) for pair in s.values
                    if pair.key == 'Inputs taken'], default=0)

    def expect_refusal(self, node, topic, event, recorded):
        """Publishes a message of the type `recorded` where the node replays events."""
        reader = '/' + node
        sender = publisher('/' + topic, recorded)
        wait_for_readers('/' + topic, reader)
        sender.publish(recorded())
        text = ('%s: recorded with another version of vegetation_sim, as %s of MD5 sum %s; this '
                'version reads %s of MD5 sum %s' % (topic, recorded._type, recorded._md5sum,
                                                    event._type, event._md5sum))
        wait_for(lambda: any(s.level == DiagnosticStatus.WARN and text in s.message
                             for s in self.statuses(node)), text)
        wait_for(lambda: any(m.level == ConsoleLine.WARN and m.msg == node + ': refused ' + text
                             for m in list(self.console.messages)), 'a line of ' + node)
        sender.unregister()
        self.assertEqual(self.taken(node), 0)

    def expect_applied(self, node, topic, event):
        sender = publisher('/' + topic, event)
        wait_for_readers('/' + topic, '/' + node)
        message = event(kind=event.RESET)
        message.header.stamp = time_of(self.clock.tick + 1)
        sender.publish(message)

        def applied():
            self.clock.run(1)
            return self.taken(node) == 1
        wait_for(applied, 'the event of this version')

    def test_events_of_the_forest(self):
        self.expect_refusal('forest_animator', 'forest/events', ForestEvent, old(ForestEvent))
        self.expect_applied('forest_animator', 'forest/events', ForestEvent)

    def test_events_of_the_grass(self):
        self.expect_refusal('grass_field', 'grass/events', GrassEvent, old(GrassEvent))
        self.expect_applied('grass_field', 'grass/events', GrassEvent)

    def test_events_of_leaves(self):
        self.expect_refusal('canopy_animator', 'canopy/events', CanopyEvent, old(CanopyEvent))
        self.expect_applied('canopy_animator', 'canopy/events', CanopyEvent)

    def test_events_of_people(self):
        self.expect_refusal('agent_crowd', 'agents/events', CrowdEvent, old(CrowdEvent))
        self.expect_refusal('agent_crowd', 'agents/events', CrowdEvent, String)
        self.expect_applied('agent_crowd', 'agents/events', CrowdEvent)


if __name__ == '__main__':
    rospy.init_node('old_recordings_test')
    rostest.rosrun('vegetation_sim', 'old_recordings', OldRecordings)
