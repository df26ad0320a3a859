#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes media/stone: the boulder of scripts/rolling_stone.py as a mesh with a texture. Its farthest
point is 1 from its middle. It needs numpy and Pillow."""
import itertools
import pathlib

import numpy
from PIL import Image

FOLDER = pathlib.Path(__file__).absolute().parent.parent / 'media' / 'stone'
SPLITS = 4  # of each face of the octahedron from which the surface is made
FACES = 26  # flat places of the stone
SEED = 46  # of these places; one of them is near the ground where the stone does not roll
SHARPNESS = 16.0  # of the edges between them
SHAPE = numpy.array((1.0, 0.92, 0.96))  # diameters along the axes, relative to each other
EDGE, FINER = 256, 2  # pixels of the texture, and as many more while it is drawn
LATTICE = 32  # points of the noise along an edge
DARKEST = 0.42  # colour of the darkest pixel; no part of the stone is black
GREY, WARM, LICHEN = (0.74, 0.73, 0.71), (0.77, 0.71, 0.63), (0.74, 0.76, 0.66)


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def noise(at, frequency, seed):
    """Returns smooth random numbers from 0 to 1 at places near the unit sphere."""
    lattice = numpy.random.RandomState(seed).uniform(size=(LATTICE,) * 3)
    place = frequency * numpy.asarray(at) + 0.37 * seed
    cell = numpy.floor(place).astype(int)
    share = place - cell
    share = share * share * (3.0 - 2.0 * share)
    out = 0.0
    for corner in itertools.product((0, 1), repeat=3):
        weight = numpy.prod(numpy.where(corner, share, 1.0 - share), axis=-1)
        out = out + weight * lattice[tuple(((cell + corner) % LATTICE)[..., k] for k in range(3))]
    return out


def fractal(at, frequency, seed):
    return sum(0.5 ** i * noise(at, 2.1 ** i * frequency, seed + i) for i in range(4)) / 1.875


def reach(directions):
    """Returns the distance from the middle to the surface: rounded flat places, and bumps."""
    random = numpy.random.RandomState(SEED)
    normals = unit(random.normal(size=(FACES, 3)))
    away = random.uniform(0.84, 1.0, FACES)
    towards = numpy.maximum(directions @ normals.T, 0.0) / away
    flat = numpy.sum(towards ** SHARPNESS, axis=-1) ** (-1.0 / SHARPNESS)
    bumps = 0.09 * (fractal(directions, 2.4, 20) - 0.5) + 0.035 * (fractal(directions, 7.0, 30) - 0.5)
    return numpy.minimum(flat, 1.0) + bumps


def surface(directions):
    return SHAPE * directions * reach(directions)[..., None]


def normals_at(directions, step=0.02):
    """Returns the normals of the surface, outwards."""
    side = unit(numpy.cross(directions, numpy.where(numpy.abs(directions[..., :1]) < 0.8,
                                                    (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))))
    other = numpy.cross(directions, side)
    along = [surface(unit(directions + step * way)) - surface(unit(directions - step * way))
             for way in (side, other)]
    return unit(numpy.cross(*along))


def unfold(direction, signs):
    """Returns the place of a direction in the octant with these signs, in a square of 0 to 1."""
    x, y, z = direction / numpy.abs(direction).sum()
    if signs[2] < 0:
        x, y = signs[0] * (1.0 - abs(y)), signs[1] * (1.0 - abs(x))
    return 0.5 + 0.5 * numpy.array((x, y)) * (1.0 - 1.0 / EDGE)  # Filters need half a pixel.


def fold(places):
    """Returns the directions of places in the square, the inverse of unfold()."""
    x, y = numpy.moveaxis(2.0 * places - 1.0, -1, 0) / (1.0 - 1.0 / EDGE)
    z = 1.0 - numpy.abs(x) - numpy.abs(y)
    below = z < 0.0
    sign = [numpy.where(v < 0.0, -1.0, 1.0) for v in (x, y)]
    out = (numpy.where(below, sign[0] * (1.0 - numpy.abs(y)), x),
           numpy.where(below, sign[1] * (1.0 - numpy.abs(x)), y), z)
    return unit(numpy.stack(out, axis=-1))


def sphere_faces():
    """Returns faces of a unit sphere, counterclockwise from outside, with the signs of their
    octants."""
    faces = []
    for signs in itertools.product((-1, 1), repeat=3):
        face = [sign * axis for sign, axis in zip(signs, numpy.eye(3))]
        faces.append((face if numpy.prod(signs) > 0 else face[::-1], signs))
    for _ in range(SPLITS):
        finer = []
        for (a, b, c), signs in faces:
            ab, bc, ca = (unit(i + j) for i, j in ((a, b), (b, c), (c, a)))
            finer += [(face, signs) for face in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        faces = finer
    return faces


def write_mesh():
    corners, places, lines = {}, {}, []
    for face, signs in sphere_faces():
        texts = []
        for direction in face:
            corner = corners.setdefault(tuple(numpy.round(direction, 6)), len(corners) + 1)
            place = places.setdefault('vt %.4f %.4f' % tuple(unfold(direction, signs)),
                                      len(places) + 1)
            texts.append('%d/%d/%d' % (corner, place, corner))
        lines.append('f ' + ' '.join(texts))
    directions = unit(numpy.array(list(corners)))
    points = surface(directions)
    points /= numpy.linalg.norm(points, axis=-1).max()
    head = ['mtllib stone.mtl', 'o stone', 'usemtl stone']
    head += ['v %.4f %.4f %.4f' % tuple(point) for point in points] + list(places)
    head += ['vn %.2f %.2f %.2f' % tuple(normal + 0.0)
             for normal in numpy.round(normals_at(directions), 2)]
    (FOLDER / 'stone.obj').write_text('\n'.join(head + lines) + '\n')


def write_texture():
    """Writes mottled stone with lichen and cracks. Hollows get less light."""
    count = EDGE * FINER
    line = (numpy.arange(count) + 0.5) / count
    places = numpy.stack(numpy.meshgrid(line, 1.0 - line), axis=-1)
    at = fold(places)

    def mix(a, b, share):
        return a + (numpy.array(b) - a) * numpy.clip(share, 0.0, 1.0)[..., None]

    paint = mix(numpy.array(GREY), WARM, 2.5 * fractal(at, 1.6, 40) - 0.75)
    lichen = fractal(at, 3.3, 50) + 0.25 * (noise(at, 24.0, 61) - 0.5)
    paint = mix(paint, LICHEN, 9.0 * (lichen - 0.60))
    bumps = fractal(at, 7.0, 30) - 0.5
    fine = fractal(at, 16.0, 70) - 0.5
    crack = numpy.abs(fractal(at, 2.2, 80) - 0.5)
    light = 1.0 + 0.55 * bumps + 0.6 * fine - 0.28 * numpy.clip(1.0 - crack / 0.012, 0.0, 1.0)
    paint = paint * light[..., None]
    paint = paint.reshape(EDGE, FINER, EDGE, FINER, 3).mean(axis=(1, 3))
    steps = numpy.rint(32.0 * numpy.clip(paint, DARKEST, 1.0)) / 32.0  # a smaller file
    Image.fromarray(numpy.rint(255.0 * steps).astype('uint8'), 'RGB').save(
        FOLDER / 'stone.png', optimize=True)


if __name__ == '__main__':
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_mesh()
    write_texture()
    # The light of rviz shines from the camera; the rest of the stone glows as if in skylight.
    (FOLDER / 'stone.mtl').write_text('newmtl stone\nKd 0.36 0.35 0.33\nKe 0.30 0.30 0.29\n'
                                      'map_Kd stone.png\n')
