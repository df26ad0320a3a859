#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the test cases in the XML results under a folder.

Prints each failed case with its message, each file's counts, and last "PASSED FAILED SKIPPED".
"""
import pathlib
import sys
import xml.etree.ElementTree as tree


def is_failed(case):
    return case.find('failure') is not None or case.find('error') is not None


def failed_case(name):
    case = tree.Element('testcase', {'name': name})
    tree.SubElement(case, 'failure')
    return case


def read(path):
    """Returns the test cases of one result file. A file that is not XML is one failed case. Failed
    subtests of Python are only in the sum of their suite, and become failed cases here."""
    try:
        root = tree.parse(path)
    except tree.ParseError as error:
        return [failed_case(str(error))]
    cases = list(root.iter('testcase'))
    stated = sum(int(suite.get(kind) or 0) for suite in root.iter('testsuite')
                 for kind in ('failures', 'errors'))
    unnamed = stated - sum(map(is_failed, cases))
    return cases + [failed_case('a subtest')] * unnamed


def main():
    total = [0, 0, 0]
    for path in sorted(pathlib.Path(sys.argv[1]).rglob('*.xml')):
        counts = [0, 0, 0]
        for case in read(path):
            problems = case.findall('failure') + case.findall('error')
            skipped = case.find('skipped') is not None or case.get('status') == 'notrun'
            # The case that rostest adds says only that its tests ran; those are counted in files of
            # their own.
            if problems or not path.stem.startswith('rostest-'):
                counts[1 if problems else 2 if skipped else 0] += 1
            for problem in problems:
                print('FAILED  %s.%s\n%s' % (case.get('classname', path.stem), case.get('name'),
                                             problem.get('message') or problem.text or ''))
        print('%4d passed, %d failed, %d skipped  %s' % (*counts, path.stem))
        total = [a + b for a, b in zip(total, counts)]
    print(*total)


main()
