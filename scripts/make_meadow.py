#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the images of config/meadow: 49 x 49 grey 8-bit samples, 2 m apart, north first.

The patches are sums of plane waves with fixed seeds. Density is lower on two worn spots. The images
are height, density, colour and the share of the flowers.
usage: scripts/make_meadow.py FOLDER
"""
import math
import os
import random
import struct
import sys
import zlib

SIDE = 49
SPACING = 2.0  # [m]; the middle sample is the origin of the world
WORN = [(9.0, 5.0, 5.0), (-14.0, -9.0, 4.0)]  # x, y, radius [m]


def patches(seed, shortest, longest):
    """Returns a smooth function of the position with values mostly within -1 to 1."""
    draw = random.Random(seed).random
    parts = []
    for _ in range(10):
        number = 2.0 * math.pi / (shortest * (longest / shortest) ** draw())
        heading = 2.0 * math.pi * draw()
        parts.append((number * math.cos(heading), number * math.sin(heading), 2.0 * math.pi * draw()))
    return lambda x, y: sum(math.sin(a * x + b * y + c) for a, b, c in parts) / math.sqrt(10.0)


def picture(value):
    half = SIDE // 2
    return [[round(255 * min(1.0, max(0.0, value(SPACING * x, SPACING * y))))
             for x in range(-half, half + 1)] for y in range(half, -half - 1, -1)]


def worn(x, y):
    """Returns 0 in the middle of a worn spot and 1 outside."""
    out = 1.0
    for at_x, at_y, radius in WORN:
        far = ((x - at_x) ** 2 + (y - at_y) ** 2) / radius ** 2
        out *= 1.0 - math.exp(-far * far)
    return out


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png(rows):
    lines = b''.join(b'\0' + bytes(row) for row in rows)
    header = struct.pack('>IIBBBBB', SIDE, SIDE, 8, 0, 0, 0, 0)  # 8-bit greyscale
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(lines, 9)) +
            chunk(b'IEND', b''))


def main(folder):
    tall, dense = patches(3, 14.0, 60.0), patches(5, 8.0, 40.0)
    dry, flowers = patches(8, 10.0, 50.0), patches(13, 7.0, 18.0)
    layers = {
        'height': lambda x, y: (0.5 + 0.3 * tall(x, y)) * (0.4 + 0.6 * worn(x, y)),
        'density': lambda x, y: (0.75 + 0.2 * dense(x, y)) * worn(x, y),
        'colour': lambda x, y: 0.3 + 0.4 * dry(x, y) + 0.3 * (1.0 - worn(x, y)),
        'flowers': lambda x, y: 0.9 * flowers(x, y) - 0.35,
    }
    for name, value in layers.items():
        with open(os.path.join(folder, name + '.png'), 'wb') as out:
            out.write(png(picture(value)))


if __name__ == '__main__':
    main(sys.argv[1])
