#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes config/terrain/hills.png: rolling hills with a gentle middle, 257 x 257 grey 16-bit
samples.

The height is a sum of plane waves with a fixed seed and wavelengths of 35 to 160 m. The amplitude
falls with the square of the wave number, and it is damped near the origin.
usage: scripts/make_hills.py FILE
"""
import math
import random
import struct
import sys
import zlib

SIDE = 257  # Number of samples per side, 1 m apart. The middle sample is the origin of the world.
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
    """Returns the damping factor of the hills: one fifth at the origin and one far away."""
    far = (x * x + y * y) / (CALM_RADIUS * CALM_RADIUS)
    return 1.0 - 0.8 * math.exp(-far)


def hills():
    """Returns the samples from black to white as rows from north to south, west to east."""
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
    header = struct.pack('>IIBBBBB', SIDE, SIDE, 16, 0, 0, 0, 0)  # 16-bit greyscale
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(lines, 9)) +
            chunk(b'IEND', b''))


if __name__ == '__main__':
    with open(sys.argv[1], 'wb') as out:
        out.write(png(hills()))
