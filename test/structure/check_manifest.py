#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that rosdep can install what package.xml names.

usage: check_manifest.py
Prints one line for each fault and exits 1 if there is one. A key must be a package of ROS Noetic
that scripts/install_dependencies.sh installs too, or one of KEYS, and each package of Noetic that
the script installs must be a key. Keys are compared with the script, because rosdep needs a network.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
PREFIX = 'ros-noetic-'
# Keys of rosdep's base.yaml and python.yaml with their packages in Debian and Ubuntu.
KEYS = {
    'assimp': ['libassimp-dev'], 'assimp-dev': ['libassimp-dev'], 'eigen': ['libeigen3-dev'],
    'imagemagick': ['imagemagick'], 'libgmock-dev': ['libgmock-dev'],
    'liboctomap-dev': ['liboctomap-dev'], 'libpng-dev': ['libpng-dev'],
    'opengl': ['libgl1-mesa-dev', 'libglu1-mesa-dev'], 'pkg-config': ['pkg-config'],
    'procps': ['procps'], 'python3-matplotlib': ['python3-matplotlib'],
    'python3-numpy': ['python3-numpy'], 'python3-pil': ['python3-pil'],
    'python3-setuptools': ['python3-setuptools'], 'qtbase5-dev': ['qtbase5-dev'],
    'xdotool': ['xdotool'], 'xvfb': ['xvfb'], 'yaml-cpp': ['libyaml-cpp-dev']}
# libgl-dev is libgl1-mesa-dev of newer systems; catkin depends on setuptools.
OF_OTHER_PACKAGES = {'libgl1-mesa-dev', 'libglu1-mesa-dev', 'python3-setuptools'}


def installed_packages():
    """Returns the packages that the script installs on Ubuntu 20.04 with ROS Noetic."""
    with tempfile.NamedTemporaryFile('w') as release:
        release.write('ID=ubuntu\nVERSION_CODENAME=focal\n')
        release.flush()
        return set(subprocess.check_output(
            [str(ROOT / 'scripts/install_dependencies.sh'), '--list', '--checks'], text=True,
            env={**os.environ, 'OS_RELEASE': release.name}).split())


def find_faults(keys, packages):
    """Yields a text for each difference between keys of package.xml and packages of the script."""
    for key in sorted(keys):
        wanted = KEYS.get(key, [PREFIX + key.replace('_', '-')])
        for package in sorted(set(wanted) - packages - OF_OTHER_PACKAGES):
            yield 'package.xml: %s needs %s, which the script does not install' % (key, package)
    known = {PREFIX + key.replace('_', '-') for key in keys}
    for package in sorted(packages - known):
        if package.startswith(PREFIX):
            yield 'scripts/install_dependencies.sh: %s is not a key of package.xml' % package


def main():
    manifest = ElementTree.parse(ROOT / 'package.xml').getroot()
    keys = {element.text for element in manifest if element.tag.endswith('depend')}
    faults = list(find_faults(keys, installed_packages()))
    print('\n'.join(faults), end='\n' if faults else '')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
