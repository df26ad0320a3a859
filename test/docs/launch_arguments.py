# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares arguments that are passed to launch files with those that the files declare. The loader
of roslaunch accepts unknown ones."""
from xml.etree import ElementTree

from roslaunch.substitution_args import resolve_args


def declared(file):
    """Returns the names of the arguments that a launch file accepts."""
    return {arg.get('name') for arg in ElementTree.parse(file).getroot().findall('arg')
            if arg.get('value') is None}


def unknown_in_command(file, words):
    """Returns what `name:=value` passes to a launch file that does not accept it."""
    return sorted({word.split(':=')[0] for word in words if ':=' in word} - declared(file))


def unknown_in_includes(root):
    """Returns file and arguments of each <include> that passes unknown ones."""
    faults = []
    for include in root.iter('include'):
        file = resolve_args(include.get('file'), context={'arg': {}})
        unknown = {arg.get('name') for arg in include.findall('arg')} - declared(file)
        if unknown:
            faults.append((include.get('file'), sorted(unknown)))
    return faults
