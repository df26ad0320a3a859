#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes media/plants: a fern as a mesh with a texture, and a cushion of leaves and a cloud as
slices. It needs numpy and Pillow."""
import math
import pathlib

import numpy
from PIL import Image

FOLDER = pathlib.Path(__file__).absolute().parent.parent / 'media' / 'plants'
FRONDS, PIECES = 22, 9  # A frond has PIECES pieces on each side of its stalk.
STALK = 0.1  # part of a frond without leaflets
COLUMNS, ROWS, FINER = 64, 128, 4  # pixels of the texture, and as many more while it is drawn
LEAFLETS, SLANT = 15, 0.09  # leaflets of half a frond, and their rise to the tip
CELLS, SLICES = 40, 20
CLOUD_CELLS, CLOUD_ROWS, CLOUD_SLICES = 60, 24, 20


class Mesh:
    """Builds the text of an OBJ file with two groups: rigid stalks and fronds of a texture."""

    def __init__(self):
        self.vertices, self.faces = [], {'stem': [], 'frond': []}

    def add(self, group, corners, uvs, normal):
        """Adds a face. Its corners count from 1."""
        first = len(self.vertices) + 1
        self.vertices += [(corner, uv, normal) for corner, uv in zip(corners, uvs)]
        self.faces[group] += [(first, first + i, first + i + 1) for i in range(1, len(corners) - 1)]

    def text(self):
        lines = ['mtllib fern.mtl']
        lines += ['v %.4f %.4f %.4f' % tuple(corner) for corner, _, _ in self.vertices]
        lines += ['vt %.3f %.3f' % tuple(uv) for _, uv, _ in self.vertices]
        lines += ['vn %.3f %.3f %.3f' % tuple(normal) for _, _, normal in self.vertices]
        for group, faces in self.faces.items():
            lines += ['o ' + group, 'usemtl ' + group]
            lines += ['f ' + ' '.join('%d/%d/%d' % (i, i, i) for i in face) for face in faces]
        return '\n'.join(lines) + '\n'


def unit(vector):
    return vector / numpy.linalg.norm(vector)


def frond(mesh, around, length, rise):
    """Adds two halves that meet at the stalk, where the texture has its left edge."""
    out = numpy.array([math.cos(around), math.sin(around), 0.0])
    side, up = numpy.array([-out[1], out[0], 0.0]), numpy.array([0.0, 0.0, 1.0])

    def at(s):
        return length * (out * s * (0.35 + 0.65 * s)) + rise * (1.9 * s - 1.1 * s * s) * up

    def edge(s, way):
        reach = 0.26 * length * math.sin(math.pi * (0.1 + 0.88 * s)) ** 0.8
        return at(s) + reach * (way * side - 0.2 * up)

    foot, knee = at(0.0), at(STALK)
    mesh.add('stem', [foot - 0.004 * side, foot + 0.004 * side, knee + 0.003 * side,
                      knee - 0.003 * side], [(0.0, 0.0)] * 4, out)
    shares = [STALK + (1.0 - STALK) * i / PIECES for i in range(PIECES + 1)]
    for i in range(PIECES):
        low, high = i / PIECES, (i + 1) / PIECES
        for way in (-1.0, 1.0):
            normal = unit(0.35 * way * side + 0.3 * out + up)
            mesh.add('frond', [at(shares[i]), edge(shares[i], way), edge(shares[i + 1], way),
                               at(shares[i + 1])],
                     [(0.0, low), (1.0, low), (1.0, high), (0.0, high)], normal)


def draw_frond():
    """Returns half a frond as red, green, blue and alpha: leaflets with lobes beside a stalk."""
    u = (numpy.arange(COLUMNS * FINER) + 0.5)[None, :] / (COLUMNS * FINER)
    v = 1.0 - (numpy.arange(ROWS * FINER) + 0.5)[:, None] / (ROWS * FINER)
    alpha, light = numpy.zeros((v.size, u.size)), numpy.full((v.size, u.size), 0.8)
    for number in range(LEAFLETS + 2):
        middle = (number - 1.0) / LEAFLETS + SLANT * u ** 1.4
        shape = 0.47 / LEAFLETS * numpy.clip(1.02 - u, 0.0, 1.0) ** 0.45
        lobes = 1.0 - 0.32 * numpy.abs(numpy.sin(7.5 * math.pi * u)) ** 3
        away = numpy.abs(v - middle) / (shape * lobes)
        inside = away < 1.0
        alpha[inside] = 1.0
        vein = numpy.clip(1.0 - 7.0 * away, 0.0, 1.0)
        shade = 0.72 + 0.22 * u + 0.3 * vein - 0.16 * away + numpy.where(v > middle, 0.05, 0.0)
        light[inside] = shade[inside]
    stalk = (u < 0.035 * (1.15 - v)) & (v <= 1.0)
    alpha[stalk], light[stalk] = 1.0, 0.85
    young = numpy.clip(0.25 + 0.5 * v + 0.25 * u, 0.0, 1.0)
    dark, pale = (0.10, 0.27, 0.06), (0.44, 0.62, 0.20)
    colours = [light * (a + (b - a) * young) for a, b in zip(dark, pale)]
    fine = numpy.stack(colours + [alpha], axis=-1)
    out = fine.reshape(ROWS, FINER, COLUMNS, FINER, 4).mean(axis=(1, 3))
    return numpy.clip(numpy.rint(255.0 * out), 0.0, 255.0).astype('uint8')


def write_fern():
    mesh, random = Mesh(), numpy.random.RandomState(3)
    for i in range(FRONDS):
        around = 2.399963 * i + random.uniform(-0.3, 0.3)
        frond(mesh, around, random.uniform(0.55, 0.85), random.uniform(0.5, 0.95))
    (FOLDER / 'fern.obj').write_text(mesh.text())
    (FOLDER / 'fern.mtl').write_text('newmtl stem\nKd 0.28 0.34 0.12\n'
                                     'newmtl frond\nKd 0.6 0.64 0.58\nmap_Kd fern.png\n')
    Image.fromarray(draw_frond(), 'RGBA').save(FOLDER / 'fern.png', optimize=True)


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
        density = numpy.full((CELLS // 2, CELLS), -1.0)
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
