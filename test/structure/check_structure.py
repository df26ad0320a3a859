#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the source tree with the table of folders in docs/folders.yaml.

usage: check_structure.py [--write]
Prints one line for each fault and exits 1 if there is one. Checks that
- every folder below src/ and include/ is in the table, and every row of the table is a folder;
- a file includes only files of its own folder and of the folders that its row allows;
- the rows allow no circle of folders;
- the core and the ROS layer include no library that the table keeps from them;
- public headers include only public headers, and no more of them are installed than allowed;
- a source has a header of its stem, or continues a class of a header (grab_manager_ticks.cpp: grab_manager.h);
- a test program mirrors a folder of src/;
- no folder below src/, include/ or test/ holds more files than allowed;
- each top folder, and nothing else, has a sentence in top_folders;
- the table and the picture in docs/architecture.md are those of the rows (--write updates them).
"""
import collections
import pathlib
import re
import subprocess
import sys

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
PUBLIC = 'include/vegetation_sim/'
TABLE = yaml.safe_load((ROOT / 'docs/folders.yaml').read_text(encoding='utf-8'))
CORPUS = 'test/fuzz/corpus/'  # inputs, no code
PAGE, PICTURE = 'docs/architecture.md', 'docs/folders.svg'
FOLDERS = TABLE['folders']
faults = []


def list_files():
    """Returns all files of the package that git tracks or would track."""
    names = subprocess.check_output(
        ['git', '-C', str(ROOT), 'ls-files', '-co', '--exclude-standard'], text=True).split('\n')
    return [name for name in names if name and (ROOT / name).is_file()]


FILES = list_files()
SOURCES = [name for name in FILES if re.match(r'(src|include)/.*\.(h|cpp)$', name)]


def folder_of(name):
    """Returns the folder of a file below src/ or include/vegetation_sim/."""
    path = name[len(PUBLIC):] if name.startswith(PUBLIC) else name.split('/', 1)[1]
    return path.rsplit('/', 1)[0]


def resolve(included):
    """Returns the file that an include names, or None if the package has no such file."""
    for name in ('include/' + included, 'src/' + included):
        if name in SOURCE_SET:
            return name
    return None


SOURCE_SET = set(SOURCES)
INCLUDES = {name: re.findall(r'^#include [<"]([^>"]+)[>"]', (ROOT / name).read_text(encoding='utf-8'),
                             re.M) for name in SOURCES}


def matches(entry, folder):
    """Returns whether an entry such as forest or core/* stands for a folder."""
    return folder.startswith(entry[:-1]) if entry.endswith('/*') else folder == entry


def allowed_folders(folder):
    """Returns the folders that the row of `folder` allows."""
    return {name for entry in FOLDERS[folder]['includes'] for name in FOLDERS if matches(entry, name)}


def check_rows():
    present = {folder_of(name) for name in SOURCES}
    for folder in sorted(present - set(FOLDERS)):
        faults.append('%s: the folder is not in docs/folders.yaml' % folder)
    for folder in sorted(set(FOLDERS) - present):
        faults.append('docs/folders.yaml: %s is not a folder of src/ or include/' % folder)
    for folder, row in FOLDERS.items():
        for entry in row['includes']:
            if not any(matches(entry, name) for name in FOLDERS):
                faults.append('docs/folders.yaml: %s may include %s, which does not exist' % (folder, entry))


def check_includes():
    for name in SOURCES:
        folder = folder_of(name)
        if folder not in FOLDERS:
            continue
        for included in INCLUDES[name]:
            target = resolve(included)
            if target is None:
                continue
            if target.startswith('src/') and name.startswith(PUBLIC):
                faults.append('%s: the public header includes the private header %s' % (name, included))
            other = folder_of(target)
            if other != folder and other not in allowed_folders(folder):
                faults.append('%s: includes %s, but %s may not include %s' % (name, included, folder, other))


def check_circles():
    """Finds circles of folders, except a reference folder with the one folder whose variants it
    holds."""
    done, path = set(), []

    def visit(folder):
        if folder in path:
            circle = path[path.index(folder):]
            if not (len(circle) == 2 and any(name.startswith('reference/') for name in circle)):
                faults.append('docs/folders.yaml: circle of folders %s' % ' -> '.join(circle + [folder]))
            return
        if folder in done:
            return
        path.append(folder)
        for other in sorted(allowed_folders(folder) - {folder}):
            visit(other)
        path.pop()
        done.add(folder)

    for folder in sorted(FOLDERS):
        visit(folder)


def check_libraries():
    for rule in TABLE['libraries']:
        for name in SOURCES:
            if re.match(rule['below'], folder_of(name) + '/'):
                for included in INCLUDES[name]:
                    if resolve(included) is None and re.match(rule['never'], included):
                        faults.append('%s: includes %s, but %s' % (name, included, rule['because']))


def check_public_headers():
    public = [name for name in SOURCES if name.startswith('include/')]
    for name in public:
        if not name.startswith(PUBLIC):
            faults.append('%s: public headers lie below %s' % (name, PUBLIC))
    if len(public) > TABLE['most_public_headers']:
        faults.append('%d headers are installed, allowed are %d' % (len(public), TABLE['most_public_headers']))


def continues(stem, others):
    """Returns whether a file continues a class of a header: grab_manager_ticks.cpp continues
    grab_manager.h."""
    return any(stem.startswith(other + '_') for other in others)


def check_stems():
    headers = collections.defaultdict(set)
    for name in SOURCES:
        if name.endswith('.h'):
            headers[folder_of(name)].add(pathlib.Path(name).stem)
    for name in SOURCES:
        stem = pathlib.Path(name).stem
        known = headers[folder_of(name)]
        if name.endswith('.cpp') and stem not in known and not continues(stem, known) and \
                name not in TABLE['programs']:
            faults.append('%s: no header %s.h, nor one whose name it continues' % (name, stem))
    for name in TABLE['programs']:
        if name not in SOURCE_SET:
            faults.append('docs/folders.yaml: the program %s does not exist' % name)


def check_tests():
    stems = collections.defaultdict(set)
    for name in SOURCES:
        stems[folder_of(name)].add(re.sub(r'-inl$', '', pathlib.Path(name).stem))
    known_tests = TABLE['tests_of_several_files']
    for name in FILES:
        match = re.match(r'test/(.*)/(\w+)_test\.cpp$', name)
        if not match or match.group(1).startswith('nodes/') or match.group(1).split('/')[0] in ('golden', 'fuzz'):
            continue
        folder, stem = match.groups()
        if folder not in FOLDERS:
            faults.append('%s: mirrors no folder of src/' % name)
        elif stem not in stems[folder] and name[len('test/'):-len('_test.cpp')] not in known_tests:
            faults.append('%s: no file %s in %s, nor a line in tests_of_several_files' % (name, stem, folder))
    for test in known_tests:
        if 'test/%s_test.cpp' % test not in FILES:
            faults.append('docs/folders.yaml: tests_of_several_files names %s, which does not exist' % test)


def check_sizes():
    count = collections.Counter(name.rsplit('/', 1)[0] for name in FILES
                                if name.startswith(('src/', 'include/', 'test/')) and not name.startswith(CORPUS))
    for folder, files in sorted(count.items()):
        if files > TABLE['most_files']:
            faults.append('%s: %d files, allowed are %d' % (folder, files, TABLE['most_files']))


def check_top_folders():
    top = {name.split('/')[0] for name in FOLDERS}
    for folder in sorted(top ^ set(TABLE['top_folders'])):
        faults.append('docs/folders.yaml: %s is in only one of folders and top_folders' % folder)


def draw_table():
    lines = ['|folder|what it holds|', '|---|---|']
    lines += ['|`%s`|%s|' % (folder, holds) for folder, holds in TABLE['top_folders'].items()]
    return '\n'.join(lines) + '\n'


def draw_matrix():
    """Draws the allowed includes: a mark in the row of a folder and the column of another."""
    names, cell, left, top = list(FOLDERS), 12, 130, 130
    size = cell * len(names)
    out = ['<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" font-family="sans-serif" '
           'font-size="10">' % (left + size + 10, top + size + 10),
           '<rect width="100%" height="100%" fill="white"/>']
    for i, name in enumerate(names):
        middle = i * cell + 9
        if i % 2 == 0:
            out.append('<rect x="0" y="%d" width="%d" height="%d" fill="#f1f4ee"/>' % (
                top + i * cell, left + size, cell))
        out.append('<text x="%d" y="%d" text-anchor="end">%s</text>' % (left - 4, top + middle, name))
        out.append('<text transform="translate(%d %d) rotate(-90)">%s</text>' % (left + middle, top - 4, name))
    for i, name in enumerate(names):
        out.append('<rect x="%d" y="%d" width="%d" height="%d" fill="#c9cfc4"/>' % (
            left + i * cell, top + i * cell, cell, cell))
        out += ['<circle cx="%d" cy="%d" r="4" fill="#33691e"/>' % (
            left + names.index(other) * cell + 6, top + i * cell + 6)
            for other in sorted(allowed_folders(name) - {name}, key=names.index)]
    return '\n'.join(out + ['</svg>', ''])


def check_page(write):
    mark, end = '<!-- written by check_structure.py --write: folders -->\n', '<!-- end of folders -->'
    page = (ROOT / PAGE).read_text(encoding='utf-8')
    head, _, rest = page.partition(mark)
    _, _, tail = rest.partition(end)
    drawn = {PAGE: head + mark + draw_table() + end + tail, PICTURE: draw_matrix()}
    for name, text in drawn.items():
        path = ROOT / name
        if path.exists() and path.read_text(encoding='utf-8') == text:
            continue
        if write:
            path.write_text(text, encoding='utf-8')
        else:
            faults.append('%s: differs from docs/folders.yaml; update it by check_structure.py --write' % name)


check_rows()
if not faults:
    check_includes()
    check_circles()
check_libraries()
check_public_headers()
check_stems()
check_tests()
check_sizes()
check_top_folders()
check_page('--write' in sys.argv[1:])
print('\n'.join(faults))
sys.exit(1 if faults else 0)
