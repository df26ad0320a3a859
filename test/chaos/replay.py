# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Replays of recorded events by fresh nodes, with a clock that shows each tick of the live run."""
import os
import subprocess
import threading

import roslib.packages
import rospy
from nav_msgs.msg import OccupancyGrid
from rosgraph_msgs.msg import Clock
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import ForestLayout, WindField
from vegetation_sim.srv import SaveSnapshot

from raw_messages import STATE_HASHES, class_of_bytes, kind_of, make_raw, stamp_of
from scene import NANOSECONDS, SIMULATIONS
from waiting import wait_for
from watched_node import all_delivered, publisher

BATCH, WINDOW = 40, 8  # ticks that events are ahead of the clock, and the clock of the states
MOST_INPUTS = 4        # to which the events of a batch refer: a node keeps eight, those of two batches
COVER_AHEAD = NANOSECONDS  # [ns]
DEADLINE = 60.0        # [s] of wall time for a tick
# Kinds of events that refer to an input by the name of a field, and the input.
REFERENCES = {'forest_animator': {1: 'wind_hash'}, 'canopy_animator': {1: 'wind_hash'},
              'agent_crowd': {5: 'input_hash'}, 'grass_field': {}}


class Replay:
    """One node that receives only recorded events."""

    def __init__(self, node, recording, parameters, folder):
        self.node, self._record = node, recording.nodes[node]
        self._recording, self._name = recording, '/replay/' + node
        self._parameters = dict(parameters, replay=True, replay_delay=0.0, checkpoint=False,
                                checkpoint_period=0.0, snapshot_folder=os.path.join(folder, 'replay'))
        state, events, self._event_class, _ = SIMULATIONS[node]
        self.hashes, self._stamp, self._news = {}, 0, threading.Condition()
        self._subscriber = rospy.Subscriber('/replay/' + state, rospy.AnyMsg, self._on_state,
                                            tcp_nodelay=True)
        self._clock = publisher('/replay/clock', Clock)
        self._events = self._target('/replay/' + events, self._event_class)
        self._inputs = {'wind_hash': (self._target('/replay/wind', WindField), recording.winds),
                        'input_hash': (self._target('/replay/forest/layout', ForestLayout),
                                       recording.layouts)}
        self._cover = self._target('/replay/grass/cover/resistance', OccupancyGrid)
        self._covers = list(recording.covers)
        self._frames = rospy.ServiceProxy(self._name + '/tf2_frames', FrameGraph)

    @staticmethod
    def _target(topic, message_class):
        raw_class = class_of_bytes(message_class)
        return publisher(topic, raw_class), raw_class

    @staticmethod
    def _send(target, raw):
        target[0].publish(make_raw(target[1], raw))

    def _on_state(self, message):
        raw = message._buff
        with self._news:
            self._stamp = stamp_of(raw)
            value = STATE_HASHES[self.node](raw)
            if value:
                self.hashes[self._stamp] = value
            self._news.notify_all()

    def run(self):
        """Runs all ticks. Returns the hash of the final state."""
        rospy.set_param(self._name, self._parameters)
        program = roslib.packages.find_node('vegetation_sim', self.node)[0]
        process = subprocess.Popen([program, '__name:=' + self.node, '__ns:=/replay',
                                    '/clock:=/replay/clock'])
        try:
            wait_for(self._connected, 'the replay of ' + self.node)
            self._run_ticks(sorted(self._record.ticks | set(self._record.events)))
            return rospy.ServiceProxy(self._name + '/save_snapshot', SaveSnapshot)(name='final').hash
        finally:
            process.terminate()
            process.wait()
            self._close()

    def _connected(self):
        inputs = {field: row[0][0] for field, row in self._inputs.items()}
        needed = [inputs[field] for field in set(REFERENCES[self.node].values())]
        return all(one.get_num_connections()
                   for one in [self._clock, self._events[0], self._subscriber] + needed)

    def _run_ticks(self, ticks):
        """The events of a batch are sent before the node runs the ticks of the batch before."""
        before = []
        for batch in self._batches(ticks):
            for stamp in batch:
                self._send_tick(stamp)
            wait_for(all_delivered, 'the events to be in the socket of ' + self.node)
            self._run_batch(before)
            before = batch
        self._run_batch(before)

    def _batches(self, ticks):
        """Yields lists of ticks with few inputs, of which a node keeps only the newest."""
        batch, inputs = [], 0
        for stamp in ticks:
            own = sum(kind_of(raw) in REFERENCES[self.node]
                      for raw in self._record.events.get(stamp, ()))
            if batch and (len(batch) == BATCH or inputs + own > MOST_INPUTS):
                yield batch
                batch, inputs = [], 0
            batch.append(stamp)
            inputs += own
        yield batch

    def _run_batch(self, ticks):
        for number, stamp in enumerate(ticks):
            self._clock.publish(Clock(rospy.Time(0, stamp)))
            if number >= WINDOW:
                self._wait(ticks[number - WINDOW])
        if ticks:
            self._wait(ticks[-1])

    def _wait(self, stamp):
        with self._news:
            if not self._news.wait_for(lambda: self._stamp >= stamp, DEADLINE):
                raise RuntimeError('the replay of %s has stopped before %d' % (self.node, stamp))

    def _send_tick(self, stamp):
        while self._covers and stamp_of(self._covers[0]) <= stamp + COVER_AHEAD:
            self._send(self._cover, self._covers.pop(0))
        for raw in self._record.events.get(stamp, ()):
            field = REFERENCES[self.node].get(kind_of(raw))
            if field:
                self._send_input(field, raw)
            self._send(self._events, raw)

    def _send_input(self, field, raw):
        event = self._event_class()
        event.deserialize(raw)
        target, known = self._inputs[field]
        wanted = getattr(event, field)
        if wanted in known:
            self._send(target, known[wanted])
            self._settle()

    def _settle(self):
        """Returns when the node has read its sockets: its queues of inputs are short."""
        wait_for(all_delivered, 'the inputs to be in the socket of ' + self.node)
        for _ in range(2):
            self._frames()

    def _close(self):
        self._subscriber.unregister()
        for target in (self._events, self._cover, *(row[0] for row in self._inputs.values())):
            target[0].unregister()
        self._clock.unregister()
