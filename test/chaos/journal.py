# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the journals of checkpoints: which ticks a node has run, and with which events.

A recording of the published events is not complete where a node was killed: events of its last tick
may be lost on the way, or be published again with a later tick by the process that follows, and a
process that has just started publishes before the recorder is connected. The journal holds what the
state of the node depends on.
"""
import os
import struct

MAGIC = b'vegetation_sim snapshot\n'


class _Reader:
    def __init__(self, data):
        self._data, self._at = data, 0

    def number(self, form):
        value = struct.unpack_from('<' + form, self._data, self._at)[0]
        self._at += struct.calcsize('<' + form)
        return value

    def text(self):
        size = self.number('I')
        self._at += size
        return self._data[self._at - size:self._at]

    def left(self):
        return len(self._data) - self._at

    def take(self, size):
        self._at += size
        return self._data[self._at - size:self._at]


def _content(path):
    with open(path, 'rb') as file:
        return file.read()


def _stamp_of_checkpoint(path):
    reader = _Reader(_content(path)[len(MAGIC):])
    reader.number('I')  # version
    reader.text()       # node
    reader.number('Q')  # hash of the layout
    return reader.number('q')


def _ticks_of_journal(path):
    """Returns the stamps [ns] of the ticks and the messages of their events, as bytes."""
    ticks, reader = {}, _Reader(_content(path))
    if reader.left() < 8:
        return ticks
    reader.number('Q')  # key of the checkpoint
    while reader.left() >= 4:
        length = reader.number('I')
        if reader.left() < length + 8:  # the last record is not complete
            break
        body = _Reader(reader.take(length))
        reader.number('Q')  # checksum
        stamp = body.number('q')
        events = [(body.text(), body.text())[0] for _ in range(body.number('I'))]
        if stamp:
            ticks[stamp] = events
    return ticks


def read_journal(folder, node):
    """Returns the stamp of the checkpoint of a node, and the ticks after it with their events."""
    path = os.path.join(folder, 'checkpoint', node)
    before = _stamp_of_checkpoint(path + '.snapshot')
    ticks = _ticks_of_journal(path + '.journal')
    if _stamp_of_checkpoint(path + '.snapshot') != before:  # replaced meanwhile
        return read_journal(folder, node)
    # A process that was killed while it wrote a checkpoint has left the journal of the one before.
    return before, {stamp: events for stamp, events in ticks.items() if stamp > before}
