# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the snippets in README.md and docs: fenced and indented blocks, and command lines."""
import ast
import glob
import os
import re
import shutil

import roslib.packages

PACKAGE = roslib.packages.get_pkg_dir('vegetation_sim')
PAGES = ['README.md'] + [os.path.relpath(path, PACKAGE) for path in sorted(
    glob.glob(PACKAGE + '/docs/**/*.md', recursive=True))]
FENCE = r'^```(\w*)\n(.*?)^```'
# A command line begins with a program of the machine, of the package, or one of these.
PROGRAMS = {'.', 'apt', 'apt-get', 'catkin', 'catkin_make', 'cd', 'docker', 'export', 'git', 'pip',
            'pip3', 'rviz', 'source', 'sudo', 'xvfb-run'}
OWN_PROGRAM = re.compile(r'(\./|scripts/|devel/|build/|examples/)\S+|\w+_bench')
INLINE = re.compile(r'(ros\w+|rviz|timeout|docker|sudo|(\$\(rospack find \w+\)/)?(scripts|devel)/\S+)\s+\S.*'
                    r'|catkin_make', re.S)
SHELL = ('', 'sh', 'bash', 'console')  # languages of blocks of command lines
STATEMENTS = (ast.Import, ast.ImportFrom, ast.With, ast.For)


def text(page):
    with open(os.path.join(PACKAGE, page)) as file:
        return file.read()


def blocks(body):
    """Yields language and text of each block: of a fence, 'python' for indented Python, or ''."""
    yield from re.findall(FENCE, body, re.S | re.M)
    for lines in re.findall(r'(?:^    .*\n(?:\n(?=    ))*)+', without_fences(body), re.M):
        block = re.sub('^    ', '', lines, flags=re.M)
        yield 'python' if is_python(block) else '', block


def without_fences(body):
    return re.sub(FENCE, '', body, flags=re.S | re.M)


def fenced(page, language):
    return [block for found, block in re.findall(FENCE, text(page), re.S | re.M) if found == language]


def is_python(block):
    """A formula can often be parsed too, but it contains no statement."""
    try:
        nodes = list(ast.walk(ast.parse(block)))
    except SyntaxError:
        return False
    return any(isinstance(node, STATEMENTS) or
               (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)) for node in nodes)


def is_command(line):
    first, *rest = line.split() or ['']
    if rest and rest[0][0] in '=<+':
        return False  # It is a formula.
    return bool(first in PROGRAMS or OWN_PROGRAM.fullmatch(first) or shutil.which(first))


def command_lines(body):
    """Yields the command lines of a page: those of its blocks, then those in its sentences."""
    for language, block in blocks(body):
        if language in SHELL:
            yield from filter(is_command, re.sub(r' +# .*', '', block).split('\n'))
    prose = re.sub('^    .*', '', without_fences(body), flags=re.M)
    for span in re.findall('`([^`]+)`', prose):
        if INLINE.fullmatch(span):
            yield ' '.join(span.split())
