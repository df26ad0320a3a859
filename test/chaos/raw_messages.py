# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads single fields of messages that rospy.AnyMsg holds as bytes, and publishes bytes."""
import struct


def header_of(raw):
    """Returns the number, the stamp [ns] and the end of the header with which a message begins."""
    number, seconds, nanoseconds, length = struct.unpack_from('<IIII', raw)
    return number, seconds * 10 ** 9 + nanoseconds, 16 + length


def publisher_of(message):
    """Returns the node that has published a message."""
    return message._connection_header['callerid'].lstrip('/')


def stamp_of(raw):
    return header_of(raw)[1]


def kind_of(raw):
    """Returns the kind of an event, which follows its header."""
    return raw[header_of(raw)[2]]


def _word(raw, at):
    return struct.unpack_from('<Q', raw, at)[0]


def _after_arrays(raw, at, *sizes):
    """Returns the end of arrays that begin at `at`, of elements of these sizes [byte]."""
    for size in sizes:
        at += 4 + size * struct.unpack_from('<I', raw, at)[0]
    return at


def _forest_hash(raw):
    at = _after_arrays(raw, header_of(raw)[2] + 4 + 1 + 1 + 8, 4)
    return _word(raw, at + 8 + 8 + 8)


def _grass_hash(raw):
    return _word(raw, header_of(raw)[2] + 4 + 1 + 8)


def _canopy_hash(raw):
    at = _after_arrays(raw, header_of(raw)[2] + 8, 2, 2)       # velocities
    at = _after_arrays(raw, at + 2 + 8 + 2 * 56 + 8, 4, 2, 2, 2)  # bent cells
    at = _after_arrays(raw, at + 1, 4, 8)                      # cut plants
    return _word(raw, at + 8 + 8)


def _crowd_hash(raw):
    return _word(raw, header_of(raw)[2])


STATE_HASHES = {'forest_animator': _forest_hash, 'grass_field': _grass_hash,
                'canopy_animator': _canopy_hash, 'agent_crowd': _crowd_hash}


def wind_hash_of(raw):
    """Returns the hash of a WindField."""
    return _word(raw, header_of(raw)[2] + 8)


def layout_hash_of(raw):
    """Returns the hash of a ForestLayout."""
    return _word(raw, header_of(raw)[2])


def class_of_bytes(message_class):
    """Returns a subclass of a message that is published as the bytes of its field `raw`."""
    class Raw(message_class):
        __slots__ = ['raw']

        def serialize(self, buff):
            buff.write(self.raw)
    return Raw


def make_raw(raw_class, raw):
    out = raw_class()
    out.raw = raw
    return out
