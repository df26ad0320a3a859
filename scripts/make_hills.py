#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes config/terrain/hills.png: rolling hills with a gentle middle, 257 x 257 grey samples of 16 bit.

A sum of plane waves of fixed seed, wavelengths 35 to 160 m, whose amplitude falls with the square
of the wave number, damped near the origin. usage: scripts/make_hills.py FILE
"""
import math
import random
import struct
import sys
import zlib

SIDE = 257  # samples, 1 m apart; the middle one is the world's origin
WAVES = 24
WHITE = 65535
CALM_RADIUS = 45.0  # [m]


def waves(seed):
    draw = random.Random(seed).random
    for _ in range(WAVES):
        length = 35.0 * (160.0 / 35.0) ** draw()
        heading = 2.0 * math.pi * draw()
        number = 2.0 * math.pi / length
        yield (number * math.cos(heading), number * math.sin(heading), 2.0 * math.pi * draw(),
               (length / 160.0) ** 2)


def calm(x, y):
    """Share of the hills that is left at a place: a fifth at the origin, all of it far away."""
    far = (x * x + y * y) / (CALM_RADIUS * CALM_RADIUS)
    return 1.0 - 0.8 * math.exp(-far)


def hills():
    """Samples from black to white, [SIDE][SIDE], north first, west to east."""
    components = list(waves(seed=4))
    half = SIDE // 2
    rows = [[calm(x, y) * sum(a * math.sin(kx * x + ky * y + phase)
                              for kx, ky, phase, a in components)
             for x in range(-half, half + 1)] for y in range(half, -half - 1, -1)]
    low, high = min(map(min, rows)), max(map(max, rows))
    return [[round(WHITE * (h - low) / (high - low)) for h in row] for row in rows]


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png(rows):
    lines = b''.join(b'\0' + struct.pack('>%dH' % SIDE, *row) for row in rows)
    header = struct.pack('>IIBBBBB', SIDE, SIDE, 16, 0, 0, 0, 0)  # 16 bit grey
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(lines, 9)) +
            chunk(b'IEND', b''))


if __name__ == '__main__':
    with open(sys.argv[1], 'wb') as out:
        out.write(png(hills()))
