#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that displays, their tests and benches compile with the headers of another OGRE, such as 1.9
of ROS Noetic.

usage: scripts/check_ogre.py FOLDER, which has Ogre.h, after scripts/build.sh in build/
"""
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def check(entry, folder):
    """Returns the errors of the compiler for one entry of the compilation database."""
    command = re.sub(r'\S*/include/OGRE(?=[\s/])', folder, entry['command'])
    words = [word for word in shlex.split(command) if 'ccache' not in word]
    # A precompiled header has the other OGRE in it.
    pch = [i for i, word in enumerate(words) if word.endswith('cmake_pch.hxx')]
    for i in reversed(pch):
        del words[i - 1:i + 1]
    words = [word for word in words if word not in ('-Winvalid-pch', '-Werror')]
    done = subprocess.run(words + ['-fsyntax-only'], cwd=entry['directory'], stderr=subprocess.PIPE,
                          text=True)
    return done.stderr if done.returncode else ''


def main():
    folder = os.path.abspath(sys.argv[1])
    with open(os.path.join(ROOT, 'build', 'compile_commands.json')) as file:
        entries = [entry for entry in json.load(file)
                   if re.search('[/_]rviz[/_]', entry['file']) and '/include/OGRE' in entry['command'] and
                   'cmake_pch' not in os.path.basename(entry['file'])]
    if not entries or not os.path.exists(os.path.join(folder, 'Ogre.h')):
        sys.exit('check_ogre.py: build/ has no displays, or %s has no Ogre.h' % folder)
    errors = [error for error in (check(entry, folder) for entry in entries) if error]
    print('%d of %d files that use OGRE compile with the headers in %s' % (
        len(entries) - len(errors), len(entries), folder))
    sys.exit('\n'.join(errors) if errors else 0)


if __name__ == '__main__':
    main()
