#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that launch files and rostests start programs and nodelets that exist.

usage: check_launch_files.py
Prints one line for each fault and exits 1 if there is one. A package that is not ours must be a
dependency in package.xml; ours must have the source of the program, or an executable script.
"""
import os
import pathlib
import re
import subprocess
import sys
from xml.etree import ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILES = [name for name in subprocess.check_output(
    ['git', '-C', str(ROOT), 'ls-files', '-co', '--exclude-standard'], text=True).split('\n')
    if (ROOT / name).is_file()]
MANIFEST = ElementTree.parse(ROOT / 'package.xml').getroot()
OWN = MANIFEST.findtext('name')
DEPENDENCIES = {element.text for element in MANIFEST if element.tag.endswith('depend')}
PLUGINS = {element.get('name')
           for element in ElementTree.parse(ROOT / 'nodelet_plugins.xml').iter('class')}
# How cmake/targets.cmake and cmake/tests.cmake name the program of a source.
SOURCES_OF_PROGRAMS = (r'src/nodes/.*/(\w+)_node\.cpp', r'src/tools/(\w+)\.cpp', r'bench/(\w+)\.cpp',
                       r'test/(?:nodes|ros)/.*/(\w+_test)\.cpp', r'test/rviz/.*/(\w+_rostest)\.cpp')


def find_programs():
    matches = [re.fullmatch(pattern, name) for name in FILES for pattern in SOURCES_OF_PROGRAMS]
    compiled = {match.group(1) for match in matches if match}
    scripts = {pathlib.Path(name).name for name in FILES
               if name.startswith(('scripts/', 'test/')) and os.access(ROOT / name, os.X_OK)}
    return compiled | scripts


def find_fault(element, programs):
    """Returns what is wrong with an element <node> or <test>, or None."""
    package, program = element.get('pkg'), element.get('type')
    if package != OWN:
        return None if package in DEPENDENCIES else "'%s' is no dependency in package.xml" % package
    return None if program in programs else "no source or script of the program '%s'" % program


def find_elements(name):
    """Yields the elements that start a program. launch/node.launch starts the one that an <include>
    gives it as its argument `type`."""
    for element in ElementTree.parse(ROOT / name).iter():
        if element.tag == 'include' and element.get('file').endswith('/node.launch'):
            given = {arg.get('name'): arg.get('value') for arg in element.iter('arg')}
            yield ElementTree.Element('node', pkg=OWN, type=given['type'],
                                      args='load %s/%s' % (OWN, given['type']))
        elif element.tag in ('node', 'test') and name != 'launch/node.launch':
            yield element


def find_faults(name, programs):
    for element in find_elements(name):
        fault = find_fault(element, programs)
        if fault:
            yield fault
        loaded = re.match(r'load (\S+)', element.get('args', ''))
        if loaded and loaded.group(1) not in PLUGINS:
            yield "nodelet_plugins.xml has no '%s'" % loaded.group(1)


known_programs = find_programs()
faults = ['%s: %s' % (name, fault) for name in FILES if name.endswith(('.test', '.launch'))
          for fault in find_faults(name, known_programs)]
print('\n'.join(faults))
sys.exit(1 if faults else 0)
