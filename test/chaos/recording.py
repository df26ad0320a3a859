# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Records the events that the nodes publish, the inputs to which events refer, and hashes."""
import io
import threading
from collections import defaultdict, deque

import rospy

from raw_messages import (STATE_HASHES, header_of, kind_of, layout_hash_of, publisher_of, stamp_of,
                          wind_hash_of)
from scene import NODES, OWNED, SIMULATIONS

KEPT = 20  # newest messages of each topic that has one owner


class NodeRecord:
    """Events, ticks and hashes of one node by stamps [ns]. The journals of the node say which events
    it has applied; they replace those received once all have arrived, since an event of the newest
    tick of a journal may still be on its way."""

    def __init__(self, event_class, outputs):
        self.events, self.hashes, self.ticks = defaultdict(list), {}, set()
        self.doubled = self.missing = 0  # events, where the node was killed or stopped
        self._class, self._outputs, self._journal = event_class, outputs, {}

    def add_event(self, raw):
        if kind_of(raw) not in self._outputs:
            self.events[stamp_of(raw)].append(raw)

    def add_state(self, raw, state_hash):
        self.ticks.add(stamp_of(raw))
        if state_hash:
            self.hashes[stamp_of(raw)] = state_hash

    def end_process(self, checkpoint, journal):
        """Forgets what a process that was killed has published and not written to its journal: the
        next one begins without it."""
        last = max([checkpoint, *journal])
        for stamp in [stamp for stamp in self.events if stamp > last]:
            self.doubled += len(self.events.pop(stamp))
        self.ticks = {stamp for stamp in self.ticks if stamp <= last}
        self.hashes = {stamp: value for stamp, value in self.hashes.items() if stamp <= last}
        self.take_journal(journal)

    def take_journal(self, journal):
        """Keeps ticks, and events for complete(), that may be lost on the way to the recorder."""
        self.ticks.update(journal)
        self._journal.update(journal)

    def complete(self):
        """Adds events that were lost, and removes those that were not applied."""
        for stamp, events in self._journal.items():
            received = len(self.events[stamp])
            if len(events) == received:
                continue
            self.missing += max(0, len(events) - received)
            self.doubled += max(0, received - len(events))
            self.events[stamp] = [self._published(event) for event in events]

    def _published(self, event):
        message = self._class()
        message.deserialize(event)
        message.header.frame_id = 'map'
        out = io.BytesIO()
        message.serialize(out)
        return out.getvalue()


class Recording:
    """All that a replay needs."""

    def __init__(self):
        self.lock = threading.Lock()
        self.nodes = {node: NodeRecord(row[2], row[3]) for node, row in SIMULATIONS.items()}
        self.winds, self.layouts, self.covers = {}, {}, []
        self.winds_of_owner = []  # hashes
        self.lost = 0             # messages between a node and this recorder
        self._numbers = {}
        self._newest = {topic: deque(maxlen=KEPT) for topic in OWNED}
        self._subscribers = []
        for node, (state, events, _, _) in SIMULATIONS.items():
            self._subscribe(state, self._on_state, node)
            self._subscribe(events, self._on_event, node)
        self._subscribe('wind', self._on_wind)
        self._subscribe('forest/layout', self._on_layout)
        states = {row[0] for row in SIMULATIONS.values()}
        for topic in set(OWNED) - states - {'wind', 'forest/layout', 'grass/cover/resistance'}:
            self._subscribe(topic, lambda *_: None)
        self._subscribe('grass/cover/resistance', self._on_cover)

    def connected(self):
        return all(subscriber.get_num_connections() for subscriber in self._subscribers[:-1])

    def complete(self):
        """To be called when the nodes have published their last events."""
        with self.lock:
            for record in self.nodes.values():
                record.complete()

    def _subscribe(self, topic, callback, node=None):
        def on_message(message):
            raw = message._buff
            with self.lock:
                self._count_lost(message, topic)
                if topic in OWNED and publisher_of(message) in NODES:
                    self._newest[topic].append(raw)
                if node in (None, publisher_of(message)):
                    callback(raw, publisher_of(message))
        self._subscribers.append(rospy.Subscriber('/' + topic, rospy.AnyMsg, on_message,
                                                  tcp_nodelay=True))

    def _count_lost(self, message, topic):
        """A publisher numbers its messages."""
        number = header_of(message._buff)[0]
        key = topic, id(message._connection_header)
        if '/events' in topic:
            self.lost += max(0, number - self._numbers.get(key, number - 1) - 1)
        self._numbers[key] = number

    def _on_state(self, raw, node):
        self.nodes[node].add_state(raw, STATE_HASHES[node](raw))

    def _on_event(self, raw, node):
        self.nodes[node].add_event(raw)

    def _on_wind(self, raw, publisher):
        self.winds[wind_hash_of(raw)] = raw
        if publisher == 'wind_broadcaster':
            self.winds_of_owner.append(wind_hash_of(raw))

    def _on_layout(self, raw, publisher):
        if publisher == 'forest_animator':
            self.layouts[layout_hash_of(raw)] = raw

    def _on_cover(self, raw, publisher):
        if publisher == 'grass_field':
            self.covers.append(raw)

    def rival_messages(self, topic):
        """Returns what a second publisher of a topic sends: an older message and then the newest."""
        with self.lock:
            if topic == 'wind':
                owners = self.winds_of_owner
                return [self.winds[owners[len(owners) // 2]], self.winds[owners[-1]]]
            newest = self._newest[topic]
            return [newest[0], newest[-1]] if newest else []
