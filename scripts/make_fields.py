#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the images of the fields: config/terrain/slope.png, a plane that rises to the east, and in
config/fields the grass of the scenarios vineyard, orchard and maize, north first.

usage: scripts/make_fields.py CONFIG_FOLDER
"""
import os
import struct
import sys
import zlib


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png(rows):
    """Returns an 8-bit grey image of rows of shares from 0 to 1."""
    lines = b''.join(b'\0' + bytes(round(255 * value) for value in row) for row in rows)
    header = struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(lines, 9)) +
            chunk(b'IEND', b''))


def picture(columns, rows, spacing, value):
    """Samples value(x, y) on nodes around the origin of the world."""
    xs = [spacing * (i - (columns - 1) / 2) for i in range(columns)]
    ys = [spacing * ((rows - 1) / 2 - i) for i in range(rows)]
    return png([[value(x, y) for x in xs] for y in ys])


def alleys(half_length, half_width, row_spacing, nearest):
    """Returns grass with bare strips below rows along x, of which one is at y = 0. `nearest` is the
    density at the nodes next to a strip."""
    def value(x, y):
        if abs(x) > half_length or abs(y) > half_width:
            return 1.0
        off = abs(y - row_spacing * round(y / row_spacing))
        return 0.0 if off < 0.1 else nearest if off < 0.3 * row_spacing else 1.0
    return value


def crops(inside, outside):
    """Returns `inside` where the scenario maize has wheat, 0 in its maize, and `outside` elsewhere."""
    def value(x, y):
        if x < -12.0 or x > 20.0:
            return outside
        return inside if y > 8.4 else 0.0 if y > -8.4 else outside
    return value


def main(folder):
    images = {
        'terrain/slope.png': png([[0.0, 0.5, 1.0]] * 3),
        'fields/vineyard.png': picture(121, 61, 0.55, alleys(24.0, 9.5, 2.2, 1.0)),
        'fields/orchard.png': picture(81, 51, 0.7, alleys(18.0, 11.5, 3.5, 0.5)),
        'fields/maize_density.png': picture(97, 65, 0.5, crops(0.5, 1.0)),
        'fields/maize_height.png': picture(97, 65, 0.5, crops(1.0, 0.15)),
        'fields/maize_wheat.png': picture(97, 65, 0.5, crops(1.0, 0.0)),
    }
    for name, data in images.items():
        with open(os.path.join(folder, name), 'wb') as file:
            file.write(data)


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
