#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the documentation with the code in both directions. Prints each difference and exits
with 1 if there is one.

Code to documentation: parameters and YAML keys, topics, services, dynamic_reconfigure parameters,
launch arguments, scenarios, messages and services must be mentioned between backticks in README.md
or docs/; every message field must be explained in its message or there.
Documentation to code: links, code and tests that are named must exist, and so must every
long_word_with_underscore between backticks. A range "A to B" in a table must be the declared range.
Each scenario has its rviz configuration. None draws the same plants or people twice.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
RANGE = r'\.(?:number|integer|vector)\(\s*"(\w+)",[^{;]*(\{[-\d.e]+, [-\d.e]+\}|\b[\w:]+)\)'
# An archive, `a`, has names for errors only.
FIELD = r'(?<!checker)(?<!\ba)\.(?:number|integer|vector|choice|text|flag|seed|integers|section|sections)\(\s*"(\w+)"'
TOPIC = r'(?:advertise|subscribe)(?:<[\w:]+>)?\(\s*(?:shownTopic\()?"([\w/]+)"'
SERVICE = r'(?:advertiseService|serve|serveShared)\(\s*"(\w+)"'
KNOWN_TOOLS = {'catkin_make', 'catkin_tools', 'catkin_lint', 'robot_state_publisher'}
# Faces that are drawn twice flicker.
DRAWN_TWICE = {'CanopyDisplay': 'canopy/markers', 'CrowdDisplay': 'agents/markers',
               'ForestDisplay': 'forest/markers'}
# The conventions of the package explain these fields once for all messages.
KNOWN_FIELDS = {'header', 'success', 'message', 'error_code'}


def tracked():
    names = subprocess.check_output(['git', '-C', str(ROOT), 'ls-files', '-co', '--exclude-standard'],
                                    text=True).split('\n')
    return sorted(n for n in names if n and (ROOT / n).is_file())


FILES = tracked()
faults = []


def text(name):
    return (ROOT / name).read_text(encoding='utf-8', errors='replace')


def files(pattern):
    return [name for name in FILES if re.fullmatch(pattern, name)]


DOCS = {name: text(name) for name in files(r'README\.md|docs/.*\.md')}


def spans(body):
    """Yields the texts between backticks and the blocks of code."""
    return re.findall(r'```.*?```|`[^`\n]+`', body, re.S)


MENTIONED = set()
for document in DOCS.values():
    for span in spans(document):
        MENTIONED.update(re.findall(r'[\w/]+', span))
        MENTIONED.update(re.findall(r'\w+', span))


def want(name, kind, where):
    if name not in MENTIONED:
        faults.append('%s: %s `%s` is not documented' % (where, kind, name))


def check_declarations():
    for source in files(r'src/.*\.cpp'):
        body = text(source)
        for kind, pattern in (('parameter or key', FIELD), ('topic', TOPIC), ('service', SERVICE)):
            for name in re.findall(pattern, body):
                want(name, kind, source)
    for source in files(r'cfg/.*\.cfg'):
        for name in re.findall(r'\.add\("(\w+)"', text(source)):
            want(name, 'live parameter', source)
    for source in files(r'launch/.*\.launch'):
        for name in re.findall(r'<arg name="(\w+)"[^>]*doc=', text(source)):
            want(name, 'launch argument', source)


def check_messages():
    for source in files(r'(msg|srv)/.*'):
        want(pathlib.Path(source).stem, 'type', source)
        explained = False  # A comment line above explains the fields that follow it.
        for line in text(source).split('\n'):
            field = re.match(r'[\w/\[\]]+ +(\w+)(=\S+)? *(#.*)?$', line)
            if line.startswith('#'):
                explained = True
            elif not field:
                explained = False
            elif field.group(2):
                continue  # A constant needs no explanation.
            elif not (explained or field.group(3) or field.group(1) in KNOWN_FIELDS | MENTIONED):
                faults.append('%s: field %s is not explained' % (source, field.group(1)))


def check_scenarios():
    for source in files(r'config/scenarios/.*\.yaml'):
        name = pathlib.Path(source).stem
        want(name, 'scenario', source)
        if 'rviz/%s.rviz' % name not in FILES:
            faults.append('%s: has no rviz/%s.rviz' % (source, name))
    for name in files(r'rviz/.*\.rviz'):
        for display, topic in DRAWN_TWICE.items():
            if display in text(name) and topic in text(name):
                faults.append('%s: %s and %s draw the same' % (name, display, topic))


def check_links():
    for name, body in DOCS.items():
        for link in re.findall(r'\]\(([^)#\s]+)[^)]*\)', body):
            if not re.match(r'https?:', link) and not ((ROOT / name).parent / link).exists():
                faults.append('%s: link to %s leads nowhere' % (name, link))


def check_words():
    code = '\n'.join(text(name) for name in FILES if not name.startswith('docs/') and
                     re.search(r'\.(h|cpp|py|sh|cfg|msg|srv|yaml|rviz|launch|cmake|xml|test)$|CMakeLists', name))
    known = set(re.findall(r'\w+', code.replace('${PROJECT_NAME}', 'vegetation_sim')))
    known |= {part for name in FILES for part in re.split(r'[/.]', name)}
    for name, body in DOCS.items():
        for word in re.findall(r'`([a-z]\w*[a-z]{4}_[a-z]{4}\w*)`', body):
            if word not in known | KNOWN_TOOLS:
                faults.append('%s: `%s` is not in the code' % (name, word))


def check_ranges():
    """A row "| `name` | unit | A to B | ..." must show a range that the code declares for that
    name."""
    code = {name: text(name) for name in files(r'(src|include)/.*\.(cpp|h)')}
    constants = dict(c for body in code.values() for c in re.findall(r'Range (\w+)(\{.*?\});', body))
    declared = {}
    for body in code.values():
        for name, bounds in re.findall(RANGE, body):
            bounds = re.findall(r'-?\d[\d.]*(?:e-?\d+)?', constants.get(bounds.split(':')[-1], bounds))
            if len(bounds) == 2:
                declared.setdefault(name, set()).add(tuple(map(float, bounds)))
    for name, body in DOCS.items():
        for first, shown in re.findall(r'^\| *(`[^|]*?) *\|[^|]*\| *([^|]*?) *\|', body, re.M):
            bounds = re.match(r'([-\d.e]+) to ([-\d.e]+)$', shown)
            for key in re.findall(r'`(\w+)`', first):
                if key in declared and bounds and tuple(map(float, bounds.groups())) not in declared[key]:
                    faults.append('%s: range of `%s` is %s, in the code %s' % (
                        name, key, shown, ' or '.join('%g to %g' % r for r in sorted(declared[key]))))


def check_rows():
    """The table of rows names code and tests without folder and extension."""
    for line in DOCS.get('docs/papers.md', '').split('\n'):
        cells = line.split('|')
        if len(cells) < 6:
            continue
        for cell, folders in ((cells[3], ('src/', 'include/vegetation_sim/', '')), (cells[4], ('test/',))):
            for path in re.findall(r'`([\w/]+\*?)[^`]*`', cell):
                pattern = path.replace('*', r'[\w.]*')
                if not any(re.match(folder + pattern + r'($|\.|_)', name) or
                           ('*' in path and name.startswith(folder + path.rstrip('*')))
                           for folder in folders for name in FILES):
                    faults.append('docs/papers.md: %s of %s does not exist' % (path, cells[1].strip()))


def check_imports():
    """The ROS packages that scripts and tests import must be declared in package.xml."""
    declared = set(re.findall(r'<\w*depend>(\w+)</', text('package.xml')))
    for name in files(r'(scripts|test)/.*\.py'):
        for module in re.findall(r'^(?:import|from) (\w+)', text(name), re.M):
            ros = re.match(r'ros\w+|\w+_msgs|\w+_srvs|tf2?(_\w+)?|dynamic_reconfigure', module)
            if ros and module not in declared:
                faults.append('%s: imports %s, which package.xml does not name' % (name, module))


def check_sizes():
    """A newcomer reads README in minutes, and a clone is small."""
    for name in ['README.md', *files(r'media/[^/]*')]:
        size, most = (ROOT / name).stat().st_size, 8000 if name == 'README.md' else 4000000
        if size > most:
            faults.append('%s: %d bytes, allowed are %d' % (name, size, most))


for check in (check_declarations, check_messages, check_scenarios, check_links, check_words, check_ranges,
              check_rows, check_imports, check_sizes):
    check()
print('\n'.join(sorted(set(faults))))
sys.exit(1 if faults else 0)
