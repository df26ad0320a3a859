#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The recipes of docs/tutorials/3_planner.md for messages of other packages. Debian does not have
these packages, so the classes are made from the public definitions of the messages."""
import sys
import types
import unittest
from unittest import mock

import genpy.dynamic
import rospy
import rostest
from geometry_msgs.msg import Point, Pose
from std_msgs.msg import Float32MultiArray, Header
from vegetation_sim import Grass
from vegetation_sim.msg import AgentStates, GrassCover

from pages import fenced
from waiting import wait_for

STANDARD = {'std_msgs/Header': Header._full_text, 'geometry_msgs/Point': Point._full_text,
            'geometry_msgs/Pose': Pose._full_text,
            'std_msgs/Float32MultiArray': Float32MultiArray._full_text}
# The first message of each is published. The sum is that of the packages.
GRID_MAP = '95681e052b1f73bf87b7eb984382b401', {
    'grid_map_msgs/GridMap': 'GridMapInfo info\nstring[] layers\nstring[] basic_layers\n'
                             'std_msgs/Float32MultiArray[] data\nuint16 outer_start_index\n'
                             'uint16 inner_start_index\n',
    'grid_map_msgs/GridMapInfo': 'Header header\nfloat64 resolution\nfloat64 length_x\n'
                                 'float64 length_y\ngeometry_msgs/Pose pose\n'}
PEOPLE = '18722f4b8db20cc2369740732357847b', {
    'people_msgs/People': 'Header header\npeople_msgs/Person[] people\n',
    'people_msgs/Person': 'string name\ngeometry_msgs/Point position\ngeometry_msgs/Point velocity\n'
                          'float64 reliability\nstring[] tagnames\nstring[] tags\n'}


def make_classes(checksum, definitions):
    """Returns the module PACKAGE.msg that a package with these messages would have."""
    first, *others = {**definitions, **STANDARD}.items()
    parts = [first[1]] + ['MSG: %s\n%s' % part for part in others]
    made = genpy.dynamic.generate_dynamic(first[0], ('\n' + '=' * 80 + '\n').join(parts))
    assert made[first[0]]._md5sum == checksum
    module = types.ModuleType(first[0].split('/')[0] + '.msg')
    for name in definitions:
        setattr(module, name.split('/')[1], made[name])
    return module


class Messages:
    """Keeps the messages of a topic by their stamps."""

    def __init__(self, topic, kind, stamp_of=lambda message: message.header.stamp):
        self.by_stamp = {}
        self.subscriber = rospy.Subscriber(
            topic, kind, lambda message: self.by_stamp.update({stamp_of(message): message}))


def run(block, module):
    """Runs a snippet as a node does, but returns instead of waiting."""
    package = module.__name__.split('.')[0]
    with mock.patch.dict(sys.modules, {package: types.ModuleType(package), module.__name__: module}), \
            mock.patch('rospy.init_node'), mock.patch('rospy.spin') as spin:
        exec(compile(block, '3_planner.md', 'exec'), {})
    spin.assert_called_once()


def pair(sources, results):
    """Returns a message and what a recipe has made of it."""
    stamp = wait_for(lambda: next((s for s in list(results.by_stamp) if s in sources.by_stamp), None),
                     'a message of the recipe')
    return sources.by_stamp[stamp], results.by_stamp[stamp]


class Recipes(unittest.TestCase):
    def setUp(self):
        self.grid_map, self.people = fenced('docs/tutorials/3_planner.md', 'python')

    def test_a_grid_map_has_the_values_of_the_cover_at_each_place(self):
        module = make_classes(*GRID_MAP)
        Grass().tread((-5, 1), (3, 4), radius=0.5, recovery=1e9)
        wait_for(lambda: Grass().at((3, 4))[0].crush > 0.9, 'the track')
        covers = Messages('/grass/cover/values', GrassCover)
        maps = Messages('/grass_grid_map', module.GridMap, lambda m: m.info.header.stamp)
        run(self.grid_map, module)
        cover, grid = pair(covers, maps)
        self.assertGreater(max(cover.crush), 0.9)
        self.assertEqual(grid.layers, ['density', 'height', 'crush', 'resistance', 'age'])
        self.assertEqual((grid.outer_start_index, grid.inner_start_index), (0, 0))
        self.assertEqual(grid.info.header.frame_id, cover.header.frame_id)
        for layer, data in zip(grid.layers, grid.data):
            self.check_layer(grid.info, data, cover.info, getattr(cover, layer))

    def check_layer(self, info, data, source, values):
        """Index (i, j) of grid_map counts from the corner with the largest x and y against both
        axes. Its matrices are stored by columns, so j is the outer dimension."""
        outer, inner = data.layout.dim
        self.assertEqual((outer.label, outer.size, outer.stride),
                         ('column_index', source.height, source.height * source.width))
        self.assertEqual((inner.label, inner.size, inner.stride),
                         ('row_index', source.width, source.width))
        self.assertEqual((info.resolution, info.pose.orientation.w), (source.resolution, 1.0))
        middle, south_west, cell = info.pose.position, source.origin.position, source.resolution
        for j in range(outer.size):
            for i in range(inner.size):
                x = middle.x + info.length_x / 2 - (i + 0.5) * cell
                y = middle.y + info.length_y / 2 - (j + 0.5) * cell
                row, column = int((y - south_west.y) / cell), int((x - south_west.x) / cell)
                self.assertEqual(data.data[j * inner.size + i], values[row * source.width + column])

    def test_people_are_the_walkers(self):
        module = make_classes(*PEOPLE)
        agents, people = Messages('/agents', AgentStates), Messages('/people', module.People)
        run(self.people, module)
        source, result = pair(agents, people)
        self.assertEqual(result.header.frame_id, source.header.frame_id)
        self.assertGreater(len(result.people), 0)
        self.assertEqual(
            [(p.name, p.position.x, p.position.y, p.velocity.x, p.velocity.y) for p in result.people],
            [(str(a.id), a.pose.position.x, a.pose.position.y, a.velocity.x, a.velocity.y)
             for a in source.agents])
        self.assertEqual({person.reliability for person in result.people}, {1.0})


if __name__ == '__main__':
    rospy.init_node('recipes_test')
    rostest.rosrun('vegetation_sim', 'recipes', Recipes)
