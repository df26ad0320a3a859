#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a configuration of rviz with changed properties.

usage: picture_view.py FILE.rviz [NAME/PROPERTY=VALUE ...]
NAME is a display or `View`; the value is YAML. `View=NAME` starts with this saved view. A display
is switched off by NAME/Enabled=false.
"""
import sys

import yaml


def change(root, assignment):
    path, value = assignment.split('=', 1)
    name, *keys = path.split('/')
    views = root['Views']
    if assignment.startswith('View='):
        views['Current'] = {view['Name']: view for view in views['Saved'] or []}[value]
        return
    at = views['Current'] if name == 'View' else {d['Name']: d for d in root['Displays']}[name]
    for key in keys[:-1]:
        at = at.setdefault(key, {})
    at[keys[-1]] = yaml.safe_load(value)


def main(file, *assignments):
    with open(file) as stream:
        config = yaml.safe_load(stream)
    for assignment in assignments:
        try:
            change(config['Visualization Manager'], assignment)
        except (KeyError, ValueError, IndexError):
            sys.exit('picture_view.py: %s names nothing in %s' % (assignment, file))
    yaml.safe_dump(config, sys.stdout)


if __name__ == '__main__':
    main(*sys.argv[1:])
