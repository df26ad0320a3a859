#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes media/plants: a fern as a mesh, and a cushion of leaves and a cloud as slices. It needs
numpy and Pillow."""
import math
import pathlib

import numpy
from PIL import Image

FOLDER = pathlib.Path(__file__).absolute().parent.parent / 'media' / 'plants'
FRONDS, PAIRS = 16, 13  # A frond has PAIRS pairs of leaflets.
CELLS, SLICES = 40, 20
CLOUD_CELLS, CLOUD_ROWS, CLOUD_SLICES = 60, 24, 20


class Mesh:
    """Builds the text of an OBJ file with two groups: rigid stems and leaflets."""

    def __init__(self):
        self.vertices, self.faces = [], {'stem': [], 'leaflet': []}

    def add(self, group, corners, uvs=()):
        first = len(self.vertices) + 1
        self.vertices += [(corner, uv) for corner, uv in
                          zip(corners, list(uvs) + [(0.0, 0.0)] * len(corners))]
        self.faces[group] += [(first, first + i, first + i + 1) for i in range(1, len(corners) - 1)]

    def text(self):
        lines = ['v %.4f %.4f %.4f' % tuple(corner) for corner, _ in self.vertices]
        lines += ['vt %.3f %.3f' % tuple(uv) for _, uv in self.vertices]
        for group, faces in self.faces.items():
            lines += ['o ' + group]
            lines += ['f ' + ' '.join('%d/%d' % (i, i) for i in face) for face in faces]
        return '\n'.join(lines) + '\n'


def frond(mesh, around, length, rise):
    out = numpy.array([math.cos(around), math.sin(around), 0.0])
    side = numpy.array([-out[1], out[0], 0.0])

    def at(s):
        return length * (out * s * (0.35 + 0.65 * s)) + \
            numpy.array([0.0, 0.0, rise * (1.9 * s - 1.1 * s * s)])

    for i in range(4):
        a, b = at(i / 4.0), at((i + 1) / 4.0)
        mesh.add('stem', [a - 0.004 * side, a + 0.004 * side, b + 0.003 * side, b - 0.003 * side])
    for i in range(PAIRS):
        s = 0.2 + 0.8 * (i + 0.5) / PAIRS
        foot, along = at(s), at(min(1.0, s + 0.02)) - at(s - 0.02)
        along = along / numpy.linalg.norm(along)
        reach = 0.24 * length * math.sin(math.pi * (0.12 + 0.85 * s))
        for way in (-1.0, 1.0):
            tip = foot + reach * (way * side + 0.35 * along) - numpy.array([0.0, 0.0, 0.18 * reach])
            wide = 0.030 * along
            middle = 0.45 * foot + 0.55 * tip
            mesh.add('leaflet', [foot, middle - wide, tip, middle + wide],
                     [(0.0, 0.0), (0.4, 0.5), (1.0, 1.0), (0.5, 0.6)])


def write_fern():
    mesh, random = Mesh(), numpy.random.RandomState(3)
    for i in range(FRONDS):
        around = 2.399963 * i + random.uniform(-0.3, 0.3)
        frond(mesh, around, random.uniform(0.55, 0.85), random.uniform(0.55, 0.95))
    (FOLDER / 'fern.obj').write_text(mesh.text())


def write_cushion():
    random = numpy.random.RandomState(5)
    tufts = []
    for _ in range(14):
        out, around = 0.6 * math.sqrt(random.uniform()), random.uniform(0.0, 2.0 * math.pi)
        tufts.append((out * math.cos(around), out * math.sin(around),
                      random.uniform(0.5, 0.75) - 0.5 * out, random.uniform(0.22, 0.36)))
    x = (numpy.arange(CELLS) + 0.5) / CELLS * 2.0 - 1.0
    z = 1.0 - (numpy.arange(CELLS // 2) + 0.5) / (CELLS // 2)
    for number in range(SLICES):
        y = (number + 0.5) / SLICES * 2.0 - 1.0
        density = numpy.zeros((CELLS // 2, CELLS))
        for cx, cy, cz, radius in tufts:
            square = (x[None, :] - cx) ** 2 + (y - cy) ** 2 + (1.3 * (z[:, None] - cz)) ** 2
            density = numpy.maximum(density, 1.0 - square / radius ** 2)
        noise = random.uniform(-0.35, 0.35, density.shape)
        grey = numpy.clip(255.0 * (0.5 + 1.2 * density + noise), 0.0, 255.0) * (density > -0.1)
        Image.fromarray(grey.astype('uint8')).save(FOLDER / ('cushion_%02d.png' % number),
                                                   optimize=True)


def write_cloud():
    """Writes a heap of balls on a flat base, whose edges are thin."""
    random = numpy.random.RandomState(8)
    balls = []
    for _ in range(46):
        out, around = math.sqrt(random.uniform()), random.uniform(0.0, 2.0 * math.pi)
        x, y = 0.74 * out * math.cos(around), 0.62 * out * math.sin(around)
        rise = (1.0 - out) * random.uniform(0.0, 0.62)
        balls.append((x, y, 0.14 + rise, random.uniform(0.14, 0.2) + 0.12 * (1.0 - out)))
    x = (numpy.arange(CLOUD_CELLS) + 0.5) / CLOUD_CELLS * 2.0 - 1.0
    z = (1.0 - (numpy.arange(CLOUD_ROWS) + 0.5) / CLOUD_ROWS) * 2.0 * CLOUD_ROWS / CLOUD_CELLS
    for number in range(CLOUD_SLICES):
        y = (number + 0.5) / CLOUD_SLICES * 2.0 - 1.0
        density = numpy.zeros((CLOUD_ROWS, CLOUD_CELLS))
        for cx, cy, cz, radius in balls:
            square = (x[None, :] - cx) ** 2 + (y - cy) ** 2 + (z[:, None] - cz) ** 2
            density = numpy.maximum(density, 1.0 - square / radius ** 2)
        noise = random.uniform(-0.2, 0.2, density.shape)
        grey = numpy.clip(255.0 * (0.4 + 0.9 * density + noise), 0.0, 255.0) * (density > 0.0)
        Image.fromarray(grey.astype('uint8')).save(FOLDER / ('cloud_%02d.png' % number),
                                                   optimize=True)


if __name__ == '__main__':
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_fern()
    write_cushion()
    write_cloud()
