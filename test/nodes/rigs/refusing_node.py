# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of parameters: a node that must stop at startup with an error."""
import os
import re
import subprocess
import tempfile
import unittest

import roslib.packages
import rospy

NAN, INF = float('nan'), float('inf')
BY_ROS = {'diagnostic_period'}  # the parameter of diagnostic_updater


class RefusingNode(unittest.TestCase):
    """Base of tests that start the node NODE with bad parameters."""

    NODE = None
    names = iter('started_%d' % i for i in range(1000))

    @classmethod
    def setUpClass(cls):
        cls.executable = roslib.packages.find_node('vegetation_sim', cls.NODE)[0]

    def refusal(self, parameters):
        """Starts the node, which must end with an error. Returns the error output."""
        name = next(self.names)
        rospy.set_param('/' + name, parameters)
        done = subprocess.run([self.executable, '__name:=' + name], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1, parameters)
        self.assertIn(self.NODE + ' refuses to start', done.stderr)
        plain = re.sub(r'\x1b\[\d+m', '', done.stderr)  # Remove the colours of the log.
        return plain.replace('-nan', 'nan').replace('/' + name + '/', '~')

    def expect_scenario_refused(self, text, words, others=(), by_file=True):
        """Expects an error with `words` for the text of a scenario. `others` are pairs of name and
        content of files beside it."""
        with self.subTest(words=words), tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, 'scene.yaml')
            for path, content in ((name, text.encode()), *others):
                with open(os.path.join(folder, path), 'wb') as file:
                    file.write(content)
            refusal = self.refusal({'scenario': name})
            self.assertIn(words, refusal)
            if by_file:
                self.assertIn(folder, refusal)


class Ranges:
    """Tests of all numeric parameters. The tables map each name to unit, minimum and maximum."""

    NUMBERS, WHOLE_NUMBERS, OTHERS = {}, {}, set()

    def expect_out_of_range(self, values):
        """Sets all values at once and expects an error for each with name, value and range."""
        refusal = self.refusal(values)
        for name, value in values.items():
            unit, least, most = {**self.NUMBERS, **self.WHOLE_NUMBERS}[name]
            self.assertIn('~%s = %g%s is outside %g to %g%s' % (name, value, unit, least, most,
                                                                unit), refusal)
        self.assertEqual(refusal.count('is outside'), len(values))

    def test_values_below_the_range_are_refused(self):
        values = {name: least - 0.5 for name, (_, least, _) in self.NUMBERS.items()}
        values.update({name: least - 1 for name, (_, least, _) in self.WHOLE_NUMBERS.items()})
        self.expect_out_of_range(values)

    def test_values_above_the_range_are_refused(self):
        values = {name: 2.0 * most for name, (_, _, most) in self.NUMBERS.items()}
        values.update({name: most + 1 for name, (_, _, most) in self.WHOLE_NUMBERS.items()})
        self.expect_out_of_range(values)

    def test_values_that_are_not_finite_are_rejected(self):
        for value, text in ((NAN, 'nan'), (INF, 'inf'), (-INF, '-inf')):
            refusal = self.refusal({name: value for name in self.NUMBERS})
            for name, (unit, least, most) in self.NUMBERS.items():
                self.assertIn('~%s = %s%s is not finite, allowed is %g to %g%s' % (
                    name, text, unit, least, most, unit), refusal)

    def test_numbers_of_a_wrong_type_are_refused(self):
        wrong = {name: 'often' for name in self.NUMBERS}
        wrong.update({name: 2.5 for name in self.WHOLE_NUMBERS})
        refusal = self.refusal(wrong)
        for name in self.NUMBERS:
            self.assertIn('~%s = often is not a number' % name, refusal)
        for name in self.WHOLE_NUMBERS:
            self.assertIn('~%s = 2.5 is not a whole number' % name, refusal)

    # The tables must list every known parameter, so each one gets a wrong value in these tests.
    def test_unknown_parameters_are_refused_and_the_known_ones_are_these(self):
        refusal = self.refusal({'tolerence': 2.0, 'levels': {'fixed': 3}})
        for name in ('tolerence', 'levels/fixed'):
            self.assertIn('~%s is not a known parameter; known are ' % name, refusal)
        known = set(re.search('known are (.*)', refusal).group(1).split(', '))
        self.assertEqual(known - BY_ROS,
                         self.OTHERS | set(self.NUMBERS) | set(self.WHOLE_NUMBERS))
