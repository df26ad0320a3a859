#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The program export_forest writes all files that docs/forest.md lists, with all trees (N14)."""
import csv
import pathlib
import re
import subprocess
import tempfile
import unittest
from xml.etree import ElementTree

import rostest

ROOT = pathlib.Path(__file__).resolve().parents[2]
THINNEST, RESOLUTION = '0.03', '0.05'  # [m]


class ExportForest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name) / 'model'

    def export(self, scenario):
        """Returns the names of the files that are written, and the number of trees on the output."""
        done = subprocess.run(['rosrun', 'vegetation_sim', 'export_forest',
                               str(ROOT / 'test/nodes/scenarios' / scenario), str(self.folder),
                               THINNEST, RESOLUTION], text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        trees = re.match(r'(\d+) trees with \d+ branches and \d+ cells', done.stdout)
        self.assertTrue(trees, done.stdout)
        return {path.name for path in self.folder.iterdir()}, int(trees.group(1))

    def check_trees(self, count):
        """Checks the links of the model, the lines of the table and the head of the octree."""
        links = [link.get('name') for link in
                 ElementTree.parse(self.folder / 'model.sdf').iterfind('model/link')]
        self.assertEqual([name for name in links if name != 'terrain'],
                         ['tree_%d' % tree for tree in range(count)])
        with open(self.folder / 'trees.csv', newline='') as file:
            self.assertEqual([row['tree'] for row in csv.DictReader(file)],
                             [str(tree) for tree in range(count)])
        head, cells = (self.folder / 'wood.bt').read_bytes().split(b'\ndata\n', 1)
        lines = head.decode().splitlines()
        self.assertEqual(lines[0], '# Octomap OcTree binary file')
        self.assertIn('id OcTree', lines)
        self.assertIn('res ' + RESOLUTION, lines)
        self.assertGreater(len(cells), 100 * count)
        model = ElementTree.parse(self.folder / 'model.config').getroot()
        self.assertEqual((model.findtext('name'), model.findtext('sdf')), ('model', 'model.sdf'))
        return links

    def test_all_files_that_the_page_lists_are_written(self):
        section = (ROOT / 'docs/forest.md').read_text().split('\n## Export for simulators')[1]
        listed = set(re.findall(r'`(\w+\.\w+)`', section))
        files, trees = self.export('grove.yaml')
        self.assertEqual((files, trees), (listed, 17))
        self.assertEqual(self.check_trees(trees)[-1], 'terrain')
        kinds = [line.split()[0] for line in (self.folder / 'terrain.obj').read_text().splitlines()]
        # The hills have a sample per metre of 256 m x 256 m.
        self.assertEqual((kinds.count('v'), kinds.count('f')), (257 * 257, 2 * 256 * 256))

    def test_flat_ground_is_no_mesh(self):
        files, trees = self.export('robot.yaml')
        self.assertEqual((files, trees), ({'model.config', 'model.sdf', 'trees.csv', 'wood.bt'}, 3))
        self.assertNotIn('terrain', self.check_trees(trees))


if __name__ == '__main__':
    rostest.rosrun('vegetation_sim', 'export_forest', ExportForest)
