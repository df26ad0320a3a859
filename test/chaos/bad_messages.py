# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Messages and requests of any type that no node may take: numbers that are not finite, unknown
frames and ids, stamps of a far future, lists and texts of a huge size."""
import re

import genpy
import roslib.message

NAN = float('nan')
FAR = genpy.Time(2 ** 31, 0)
MANY, MANY_PARTS, LONG = 200000, 500, 1000000  # elements, elements that are messages, letters
LARGEST = {'8': 2 ** 7 - 1, '16': 2 ** 15 - 1, '32': 2 ** 31 - 1, '64': 2 ** 63 - 1}
DEFECTS = 'not finite', 'unknown frame', 'unknown id', 'far future', 'huge'


def make_bad(message_class, defect):
    """Returns a message with a defect in every field that can have it."""
    out = message_class()
    _spoil(out, defect)
    return out


def _spoil(message, defect):
    for name, kind in zip(message.__slots__, message._slot_types):
        value = _bad_value(name, kind, getattr(message, name), defect)
        setattr(message, name, value)


def _bad_value(name, kind, value, defect):
    if isinstance(value, genpy.Message):
        _spoil(value, defect)
        return value
    if kind.endswith(']'):
        return _bad_list(kind, value, defect)
    if defect == 'not finite' and kind.startswith('float'):
        return NAN
    if defect == 'unknown frame' and name in ('frame_id', 'frame', 'attached_frame'):
        return 'no_such_frame'
    if defect == 'unknown id' and re.match('u?int', kind):
        bits = re.sub(r'\D', '', kind)
        return LARGEST[bits] if kind[0] == 'i' else 2 * LARGEST[bits] + 1
    if defect == 'far future' and kind == 'time':
        return FAR
    if defect == 'huge' and kind == 'string':
        return 'x' * LONG
    return value


def _bad_list(kind, value, defect):
    """A list gets one bad element, or a huge number of good ones."""
    if not kind.endswith('[]'):  # of fixed length
        return [NAN] * len(value) if defect == 'not finite' and 'float' in kind else value
    base = kind[:-2]
    if '/' in base or base == 'Header':
        element = roslib.message.get_message_class(base)
        if defect == 'huge':
            return [element()] * MANY_PARTS
        return [make_bad(element, defect)]
    if base in ('uint8', 'char'):
        return bytes(MANY if defect == 'huge' else 1)
    one = {'string': 'x', 'bool': False, 'time': FAR, 'duration': genpy.Duration()}.get(base, 0)
    if defect in ('not finite', 'unknown id'):
        one = _bad_value('', base, one, defect)
    return [one] * (MANY if defect == 'huge' else 1)
