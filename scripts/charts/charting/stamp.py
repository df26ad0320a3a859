# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where charts come from: commit, machine and sources of each, in DIR/charts.json."""
import hashlib
import json
import os
import pathlib
import re
import subprocess

FILE = 'charts.json'
ROOT = pathlib.Path(__file__).resolve().parents[3]  # of the package's sources, unless installed
# The widest first, by the name of the flag in /proc/cpuinfo.
INSTRUCTION_SETS = {'AVX-512': 'avx512bw', 'AVX2': 'avx2', 'SSE4': 'sse4_2', 'NEON': 'asimd'}
# Strings are kept, comments become spaces.
COMMENTS = re.compile(r'("(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\')|//[^\n]*|/\*.*?\*/', re.DOTALL)


def code_of(text):
    """Returns C++ code without comments and white space."""
    return re.sub(r'\s+', '', COMMENTS.sub(lambda match: match.group(1) or ' ', text))


def files_of(sources, root=ROOT):
    """Returns the C++ files of sources: files, and folders with their headers in include."""
    out = set()
    for source in sources:
        path = root / source
        if path.is_file():
            out.add(path)
            continue
        headers = root / source.replace('src/', 'include/vegetation_sim/', 1)
        for folder in {path, headers}:
            out.update(file for file in folder.rglob('*') if file.suffix in ('.h', '.cpp'))
    return sorted(out)


def hash_of(sources, root=ROOT):
    """Returns a hash of the code of sources, which comments and white space do not change."""
    out = hashlib.sha1()
    for file in files_of(sources, root):
        out.update(('%s\n%s\n' % (file.relative_to(root), code_of(file.read_text()))).encode())
    return out.hexdigest()[:16]


def machine():
    """Returns the name of the processor, the number of its cores, and its widest instruction
    set."""
    name, flags = 'unknown processor', set()
    try:
        text = pathlib.Path('/proc/cpuinfo').read_text()
        names = re.findall(r'^model name\s*: (.*)$', text, re.MULTILINE)
        name = names[0].strip() if names else name
        lists = re.findall(r'^(?:flags|Features)\s*: (.*)$', text, re.MULTILINE)
        flags = set(lists[0].split()) if lists else flags
    except OSError:
        pass
    sets = [known for known, flag in INSTRUCTION_SETS.items() if flag in flags]
    return ', '.join([name, '%d cores' % len(os.sched_getaffinity(0))] + sets[:1])


def commit():
    """Returns the commit of the sources, with + if files have changed since; else 'unknown'."""
    def git(*words):
        return subprocess.run(['git', '-C', str(ROOT), *words], capture_output=True, text=True,
                              check=True).stdout.strip()
    try:
        changed = git('status', '--porcelain', '--untracked-files=no', '--', '.',
                      ':!docs', ':!scripts/charts')
        return git('rev-parse', '--short=10', 'HEAD') + ('+' if changed else '')
    except (OSError, subprocess.CalledProcessError):
        return 'unknown'


def read_all(folder):
    """Returns a map from the names of the charts in a folder to their stamps."""
    path = folder / FILE
    return json.loads(path.read_text()) if path.exists() else {}


def write(folder, chart, extent):
    """Stamps a chart that has been measured now."""
    stamps = read_all(folder)
    stamps[chart.name] = {'commit': commit(), 'machine': machine(), 'extent': extent,
                          'sources': hash_of(chart.sources)}
    (folder / FILE).write_text(json.dumps(stamps, indent=1, sort_keys=True) + '\n')


def text_of(stamp):
    """Returns the line below a chart."""
    if not stamp:
        return ''
    run = {'usual': 'default'}.get(stamp['extent'], stamp['extent'])
    return 'commit %s, %s, %s run' % (stamp['commit'], stamp['machine'], run)
