#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a scene of plants of one mesh, for measurements of leaves.

usage: make_thicket.py FACES FOLDER

Writes plant.obj, scene.yaml with 625 such plants, which have FACES faces together, and
scene.launch."""
import math
import os
import random
import sys

PLANTS, COLUMNS = 625, 25


def plant(faces):
    """Returns the text of a bush of leaves of two faces each, which cover the same area for any
    number of faces."""
    numbers = random.Random(1)
    lines, first = [], 1
    for _ in range(faces // 2):
        z = numbers.uniform(-1.0, 1.0)
        around, deep = numbers.uniform(0.0, 2.0 * math.pi), 1.0 - 0.5 * numbers.random() ** 2
        ring = math.sqrt(1.0 - z * z)
        out = (ring * math.cos(around), ring * math.sin(around), z)
        root = [0.6 * deep * out[0], 0.6 * deep * out[1], 0.5 + 0.5 * deep * out[2]]
        size = 0.025 * math.sqrt(80000.0 / faces) * numbers.uniform(0.6, 1.4)
        along = [size * (out[k] + numbers.uniform(-0.9, 0.9)) for k in range(3)]
        side = [0.3 * size * numbers.uniform(-1.0, 1.0) for _ in range(3)]
        middle = [root[k] + 0.5 * along[k] for k in range(3)]
        corners = [root, [middle[k] - side[k] for k in range(3)],
                   [middle[k] + side[k] for k in range(3)], [root[k] + along[k] for k in range(3)]]
        lines += ['v %.5f %.5f %.5f' % tuple(corner) for corner in corners]
        lines += ['f %d %d %d' % (first, first + 1, first + 2),
                  'f %d %d %d' % (first + 1, first + 3, first + 2)]
        first += 4
    return '\n'.join(lines) + '\n'


def main():
    faces, folder = int(sys.argv[1]), os.path.abspath(sys.argv[2])
    with open(os.path.join(folder, 'plant.obj'), 'w') as file:
        file.write(plant(faces // PLANTS))
    numbers = random.Random(2)
    with open(os.path.join(folder, 'scene.yaml'), 'w') as file:
        file.write('wind:\n  primitives:\n'
                   '    - {name: breeze, kind: breeze, velocity: [2.0, 7.0, 0.0]}\n'
                   'canopy:\n  kinds:\n'
                   '    - {name: bush, shape: mesh, file: %s/plant.obj, height: 1.4}\n'
                   '  plants:\n' % folder)
        for i in range(PLANTS):
            row, column = divmod(i, COLUMNS)
            at = (0.9 * row + numbers.uniform(-0.2, 0.2),
                  0.8 * ((column + 1) // 2) * (-1) ** column + numbers.uniform(-0.2, 0.2))
            file.write('    - {kind: bush, position: [%.3f, %.3f, 0.0], yaw: %.2f, scale: %.2f}\n'
                       % (at + (numbers.uniform(0.0, 6.2), numbers.uniform(0.8, 1.2))))
    with open(os.path.join(folder, 'scene.launch'), 'w') as file:
        file.write("<launch><rosparam param='resource_folders'>[%s]</rosparam>"
                   "<include file='$(find vegetation_sim)/launch/demo.launch'>"
                   "<arg name='scenario_file' value='%s/scene.yaml'/><arg name='scenario' value='reef'/>"
                   "<arg name='rviz' value='false'/></include></launch>\n" % (folder, folder))


if __name__ == '__main__':
    main()
