#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes media/robots: the parts of the robots of the scenes, as meshes for URDF files and markers.
x points forward, z up; lengths are in metres. It needs numpy."""
import math
import pathlib

import numpy

FOLDER = pathlib.Path(__file__).absolute().parent.parent / 'media' / 'robots'
GLOW = 0.3  # share of a colour in the dark; rviz has one light, which shines from the camera
COLOURS = {
    'green': (0.16, 0.44, 0.18), 'blue': (0.12, 0.30, 0.66), 'dark': (0.13, 0.13, 0.14),
    'tyre': (0.07, 0.07, 0.07), 'steel': (0.55, 0.57, 0.60), 'plate': (0.38, 0.39, 0.41),
    'yellow': (0.88, 0.68, 0.10), 'white': (0.85, 0.86, 0.84), 'glass': (0.95, 0.94, 0.80),
    'amber': (0.98, 0.55, 0.05), 'red': (0.75, 0.06, 0.05)}
WHEEL_RADIUS, WHEEL_WIDTH = 0.22, 0.14
MAST_HEIGHT, MAST_RADIUS = 1.7, 0.07


class Mesh:
    """Builds the text of an OBJ file from solids of one colour."""

    def __init__(self):
        self.corners, self.normals, self.faces = {}, {}, {}  # texts and numbers

    def add(self, colour, corners, normals):
        """Adds a convex face with one normal per corner, or one for all."""
        corners = [numpy.array(corner, float) for corner in corners]
        if numpy.ndim(normals) == 1:
            normals = [normals] * len(corners)
        turn = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
        if turn @ sum(numpy.array(normal, float) for normal in normals) < 0.0:
            corners, normals = corners[::-1], normals[::-1]
        self.faces.setdefault(colour, []).append(' '.join('%d//%d' % (
            self.number(self.corners, '%.4f', corner),
            self.number(self.normals, '%.2f', normal / numpy.linalg.norm(normal)))
            for corner, normal in zip(corners, normals)))

    @staticmethod
    def number(known, form, vector):
        """Returns the number of a vector in an OBJ file, which counts from 1."""
        text = ' '.join(form % (part + 0.0) for part in numpy.round(vector, 4))
        return known.setdefault(text, len(known) + 1)

    def box(self, colour, centre, size, bevel=0.006, turn=numpy.eye(3)):
        """Adds a box with bevelled edges. @param turn rotation about its centre."""
        half = 0.5 * numpy.array(size)
        bevel = min(bevel, 0.45 * min(size))

        def put(corners):
            middle = sum(corners) / len(corners)
            edge = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
            normal = edge if edge @ middle > 0.0 else -edge
            self.add(colour, [turn @ corner + centre for corner in corners], turn @ normal)

        def corner(signs, axis):
            """Returns the corner of the face across an axis."""
            out = half - bevel
            out[axis] = half[axis]
            return out * signs

        signs = [numpy.array([a, b, c]) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
        for one in signs:
            put([corner(one, axis) for axis in range(3)])
        for axis in range(3):
            next_axis, last = (axis + 1) % 3, (axis + 2) % 3
            for way in (-1, 1):
                ring = []
                for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    one = numpy.zeros(3)
                    one[axis], one[next_axis], one[last] = way, a, b
                    ring.append(one)
                put([corner(one, axis) for one in ring])
                ends = [numpy.zeros(3), numpy.zeros(3)]  # of the edge along `last`
                for a in (-1, 1):
                    for end, b in zip(ends, (-1, 1)):
                        end[axis], end[next_axis], end[last] = way, a, b
                    put([corner(ends[0], axis), corner(ends[1], axis),
                         corner(ends[1], next_axis), corner(ends[0], next_axis)])

    def turned(self, colour, profile, foot=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0), count=24):
        """Adds a surface of revolution. @param profile radii and places along the axis, outside on
        the left of the way."""
        foot, axis = numpy.array(foot, float), numpy.array(axis, float) / numpy.linalg.norm(axis)
        side = numpy.cross(axis, (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0))
        side /= numpy.linalg.norm(side)
        other = numpy.cross(axis, side)
        angles = [2.0 * math.pi * i / count for i in range(count + 1)]
        out = [math.cos(angle) * side + math.sin(angle) * other for angle in angles]
        for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
            slope = numpy.array([z1 - z0, r0 - r1]) / math.hypot(z1 - z0, r1 - r0)
            for a, b in zip(out, out[1:]):
                low, high = foot + z0 * axis, foot + z1 * axis
                corners = [(low + r0 * a, a), (low + r0 * b, b), (high + r1 * b, b), (high + r1 * a, a)]
                corners = corners[1:] if r0 == 0.0 else corners[:3] if r1 == 0.0 else corners
                self.add(colour, [corner for corner, _ in corners],
                         [slope[0] * way + slope[1] * axis for _, way in corners])

    def rod(self, colour, start, end, radius, count=12):
        """Adds a cylinder with bevelled ends."""
        way = numpy.subtract(end, start)
        size, edge = numpy.linalg.norm(way), 0.15 * radius
        self.turned(colour, [(0.0, 0.0), (radius - edge, 0.0), (radius, edge), (radius, size - edge),
                             (radius - edge, size), (0.0, size)], start, way, count)

    def write(self, name):
        lines = ['mtllib robots.mtl']
        lines += ['v ' + corner for corner in self.corners]
        lines += ['vn ' + normal for normal in self.normals]
        for colour, faces in self.faces.items():
            lines += ['o ' + colour, 'usemtl ' + colour]
            lines += ['f ' + face for face in faces]
        (FOLDER / (name + '.obj')).write_text('\n'.join(lines) + '\n')


def about_y(angle):
    return numpy.array([[math.cos(angle), 0.0, math.sin(angle)], [0.0, 1.0, 0.0],
                        [-math.sin(angle), 0.0, math.cos(angle)]])


def write_wheel():
    """Writes a wheel that turns about y: a tyre with lugs, and the same rim on both sides."""
    mesh, half, lugs = Mesh(), 0.5 * WHEEL_WIDTH, 18
    tread, bolt_circle = WHEEL_RADIUS - 0.014, 0.062
    mesh.turned('tyre', [(0.125, -half + 0.012), (0.15, -half), (tread - 0.03, -half),
                         (tread, -half + 0.025), (tread, half - 0.025), (tread - 0.03, half),
                         (0.15, half), (0.125, half - 0.012)], axis=(0.0, 1.0, 0.0), count=36)
    for i in range(2 * lugs):
        turn = about_y(math.pi * i / lugs)
        side = 1.0 if i % 2 else -1.0
        mesh.box('tyre', turn @ (0.0, side * 0.5 * half, tread - 0.001), (0.026, half, 0.028), 0.006, turn)
    for side in (-1.0, 1.0):
        axis = (0.0, side, 0.0)
        mesh.turned('steel', [(0.128, half - 0.012), (0.12, half - 0.004), (0.108, half - 0.006),
                              (0.094, half - 0.03), (0.05, half - 0.012)], axis=axis, count=30)
        mesh.turned('plate', [(0.05, half - 0.012), (0.044, half + 0.004), (0.036, half + 0.008),
                              (0.0, half + 0.01)], axis=axis, count=18)
        for i in range(6):
            place = about_y(math.pi * i / 3.0) @ (bolt_circle + 0.008, 0.0, 0.0)
            mesh.rod('dark', place + numpy.array((0.0, side * (half - 0.035), 0.0)),
                     place + numpy.array((0.0, side * (half - 0.01), 0.0)), 0.009, 8)
    mesh.write('wheel')


def write_mast():
    """Writes a mast that stands on its flange, with a camera and the antenna of a receiver on top."""
    mesh, radius, top = Mesh(), MAST_RADIUS, MAST_HEIGHT
    mesh.turned('plate', [(0.135, 0.0), (0.135, 0.014), (0.13, 0.018), (radius + 0.03, 0.018),
                          (radius + 0.006, 0.05), (radius, 0.07)])
    for i in range(6):
        angle = math.pi * (i + 0.5) / 3.0
        place = numpy.array((0.115 * math.cos(angle), 0.115 * math.sin(angle), 0.015))
        mesh.rod('steel', place, place + numpy.array((0.0, 0.0, 0.014)), 0.011, 6)
    mesh.turned('steel', [(radius - 0.004, 0.03), (radius - 0.004, top - 0.13)])
    for height in (0.45, 1.05):
        mesh.turned('dark', [(radius - 0.004, height), (radius, height + 0.004),
                             (radius, height + 0.036), (radius - 0.004, height + 0.04)])
    mesh.rod('dark', (-radius, 0.0, 0.02), (-radius, 0.0, top - 0.12), 0.008, 8)
    mesh.box('dark', (radius + 0.012, 0.0, top - 0.3), (0.05, 0.11, 0.06), 0.01)
    for side in (-0.03, 0.03):
        mesh.rod('glass', (radius + 0.03, side, top - 0.3), (radius + 0.042, side, top - 0.3), 0.016)
    mesh.turned('plate', [(radius, top - 0.135), (radius + 0.012, top - 0.13),
                          (radius + 0.012, top - 0.11), (radius, top - 0.105)])
    dome = [(radius, top - 0.1)] + [(radius * math.cos(0.157 * i), top - 0.06 + 0.06 * math.sin(0.157 * i))
                                    for i in range(10)] + [(0.0, top)]
    mesh.turned('white', dome)
    mesh.write('mast')


def write_lidar():
    """Writes a lidar around its origin, and the bracket to a mast behind it."""
    mesh = Mesh()
    mesh.box('plate', (-0.035, 0.0, -0.072), (0.15, 0.09, 0.016), 0.004)
    mesh.box('plate', (-0.07, 0.0, -0.1), (0.05, 0.03, 0.06), 0.004)
    mesh.turned('steel', [(0.0, -0.064), (0.086, -0.064), (0.09, -0.06), (0.09, -0.025), (0.086, -0.02)])
    mesh.turned('dark', [(0.084, -0.022), (0.084, 0.036)])
    mesh.turned('steel', [(0.086, 0.032), (0.09, 0.036), (0.09, 0.05), (0.08, 0.06), (0.0, 0.062)])
    mesh.write('lidar')


def write_deck():
    """Writes a cutter bar or deck of unit size around its origin, with fingers in front."""
    mesh, fingers = Mesh(), 16
    mesh.box('dark', (0.0, 0.0, -0.2), (1.0, 1.0, 0.6), 0.05)
    mesh.box('yellow', (-0.04, 0.0, 0.25), (0.8, 0.97, 0.5), 0.1)
    mesh.box('plate', (-0.04, 0.0, 0.5), (0.5, 0.3, 0.2), 0.05)
    for i in range(fingers):
        y, half = (i + 0.5) / fingers - 0.5, 0.2 / fingers
        for way in (-1.0, 1.0):
            mesh.add('steel', [(0.45, y - half, 0.1 * way - 0.25), (0.45, y + half, 0.1 * way - 0.25),
                               (0.62, y, -0.3)], (0.3, 0.0, way))
            mesh.add('steel', [(0.45, y + half * way, -0.35), (0.45, y + half * way, -0.15),
                               (0.62, y, -0.3)], (0.2, way, 0.0))
    mesh.write('deck')


def add_lamps(mesh, x, y, z, radius):
    """Adds two lamps in front and two red ones behind."""
    for side in (-y, y):
        mesh.turned('plate', [(radius + 0.008, -0.03), (radius + 0.008, 0.012), (radius, 0.014)],
                    (x, side, z), (1.0, 0.0, 0.0), 18)
        mesh.turned('glass', [(radius, 0.008), (0.6 * radius, 0.016), (0.0, 0.02)], (x, side, z),
                    (1.0, 0.0, 0.0), 18)
        mesh.box('red', (-x - 0.004, side, z), (0.016, 2.2 * radius, 0.9 * radius), 0.004)


def write_mower():
    """Writes the hull of the mower, whose wheels are at +-0.4, +-0.36, 0.22."""
    mesh = Mesh()
    mesh.box('dark', (0.0, 0.0, 0.305), (1.02, 0.5, 0.31), 0.035)
    mesh.box('green', (0.0, 0.0, 0.53), (1.1, 0.7, 0.13), 0.04)
    mesh.box('green', (-0.25, 0.0, 0.625), (0.5, 0.46, 0.13), 0.045)
    mesh.box('plate', (0.25, 0.0, 0.6), (0.44, 0.56, 0.02), 0.006)
    for side in (-1.0, 1.0):
        mesh.box('yellow', (0.0, side * 0.349, 0.53), (0.96, 0.006, 0.022), 0.002)
        mesh.box('green', (0.0, side * 0.27, 0.4), (0.3, 0.06, 0.16), 0.025)
        mesh.box('dark', (0.0, side * 0.298, 0.41), (0.22, 0.01, 0.09), 0.004)
        for x in (-0.4, 0.4):
            mesh.rod('plate', (x, side * 0.2, 0.22), (x, side * 0.34, 0.22), 0.055, 18)
            mesh.box('dark', (x, side * 0.34, 0.462), (0.34, 0.16, 0.014), 0.005)
        for i in range(5):
            mesh.box('dark', (-0.09 - 0.08 * i, side * 0.226, 0.64), (0.05, 0.012, 0.05), 0.004)
        mesh.rod('dark', (0.48, side * 0.17, 0.28), (0.67, side * 0.17, 0.22), 0.022)
        mesh.rod('dark', (0.5, side * 0.2, 0.36), (0.575, side * 0.2, 0.36), 0.018)
    mesh.rod('plate', (0.58, -0.3, 0.36), (0.58, 0.3, 0.36), 0.022)
    for i in range(4):
        mesh.box('dark', (0.548, 0.0, 0.495 + 0.022 * i), (0.012, 0.24, 0.012), 0.003)
    add_lamps(mesh, 0.545, 0.23, 0.525, 0.034)
    for i in range(3):
        mesh.box('dark', (-0.25, -0.12 + 0.12 * i, 0.692), (0.34, 0.03, 0.012), 0.004)
    mesh.turned('dark', [(0.045, 0.0), (0.045, 0.02), (0.036, 0.024)], (-0.42, 0.14, 0.685))
    mesh.turned('amber', [(0.034, 0.02), (0.032, 0.055), (0.022, 0.07), (0.0, 0.076)],
                (-0.42, 0.14, 0.685))
    mesh.turned('red', [(0.03, 0.0), (0.03, 0.014), (0.0, 0.024)], (0.4, -0.2, 0.61))
    mesh.box('yellow', (0.4, -0.2, 0.61), (0.09, 0.09, 0.012), 0.004)
    mesh.write('mower')


def write_skid_steer():
    """Writes the hull of the robot of test/nodes/rigs/skid_steer.urdf, whose wheels are at +-0.25,
    +-0.35, -0.1 and whose mast is at 0.2, 0, 0.1."""
    mesh = Mesh()
    mesh.box('dark', (0.0, 0.0, -0.055), (0.66, 0.42, 0.09), 0.025)
    mesh.box('blue', (0.0, 0.0, 0.035), (0.7, 0.5, 0.11), 0.035)
    mesh.box('plate', (0.04, 0.0, 0.094), (0.52, 0.36, 0.016), 0.005)
    mesh.box('dark', (-0.15, 0.0, 0.135), (0.22, 0.26, 0.075), 0.02)
    for side in (-1.0, 1.0):
        mesh.box('yellow', (0.0, side * 0.249, 0.035), (0.6, 0.006, 0.018), 0.002)
        for x in (-0.25, 0.25):
            mesh.rod('steel', (x, side * 0.18, -0.1), (x, side * 0.34, -0.1), 0.03)
            mesh.rod('dark', (x, side * 0.2, -0.1), (x, side * 0.27, -0.1), 0.055, 18)
        mesh.rod('yellow', (-0.33, side * 0.19, 0.13), (0.3, side * 0.19, 0.13), 0.011)
        for x in (-0.3, 0.27):
            mesh.rod('yellow', (x, side * 0.19, 0.085), (x, side * 0.19, 0.13), 0.011)
        for end in (-1.0, 1.0):
            mesh.rod('dark', (end * 0.31, side * 0.13, -0.05), (end * 0.375, side * 0.13, -0.05), 0.013)
    for end in (-1.0, 1.0):
        mesh.rod('plate', (end * 0.385, -0.2, -0.05), (end * 0.385, 0.2, -0.05), 0.017)
    for i in range(5):
        mesh.box('plate', (-0.15, -0.1 + 0.05 * i, 0.174), (0.17, 0.012, 0.012), 0.003)
    add_lamps(mesh, 0.345, 0.17, 0.035, 0.026)
    mesh.turned('red', [(0.024, 0.0), (0.024, 0.014), (0.0, 0.022)], (-0.3, 0.11, 0.105))
    mesh.rod('dark', (-0.29, -0.14, 0.09), (-0.29, -0.14, 0.4), 0.005, 8)
    mesh.write('skid_steer')


def write_materials():
    lines = []
    for name, colour in COLOURS.items():
        glow = 0.8 if name in ('glass', 'amber') else GLOW
        lines += ['newmtl ' + name, 'Kd %.2f %.2f %.2f' % colour,
                  'Ke %.3f %.3f %.3f' % tuple(glow * part for part in colour)]
    (FOLDER / 'robots.mtl').write_text('\n'.join(lines) + '\n')


if __name__ == '__main__':
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_materials()
    write_wheel()
    write_mast()
    write_lidar()
    write_deck()
    write_mower()
    write_skid_steer()
