# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Finds and runs the package's benches."""
import os
import pathlib
import subprocess
import sys
import threading
import time

from charting.chart import Refused

PACKAGE = 'vegetation_sim'
QUIET = 30.0  # a line this often where there is no terminal to rewrite one on [s]


def folders():
    """Where programs of the package may be: beside this one, then in each space that is sourced."""
    out = [pathlib.Path(sys.argv[0]).absolute().parent]
    for space in os.environ.get('CMAKE_PREFIX_PATH', '').split(os.pathsep):
        if space:
            out.append(pathlib.Path(space) / 'lib' / PACKAGE)
    return out


def find(name):
    for folder in folders():
        program = folder / name
        if program.is_file() and os.access(program, os.X_OK):
            return program
    raise Refused('%s: no such program in %s; build it, or source setup.bash of the space that has '
                  'it' % (name, ', '.join(map(str, folders()))))


class Progress:
    """What a bench says, on one line of a terminal that is written again and again; nothing before
    show(), since benches run beside each other."""

    def __init__(self, stream=sys.stdout):
        self.stream, self.terminal, self.shown = stream, stream.isatty(), False
        self.start = self.last = time.monotonic()

    def begin(self):
        self.start = time.monotonic()

    def seconds(self):
        return time.monotonic() - self.start

    def show(self):
        self.shown = True

    def tell(self, line):
        if not self.shown:
            return
        if self.terminal:
            self.stream.write('\r\033[K  %4.0f s  %s' % (self.seconds(), line[:90]))
        elif time.monotonic() - self.last > QUIET:
            self.last = time.monotonic()
            self.stream.write('  %4.0f s  %s\n' % (self.seconds(), line[:90]))
        self.stream.flush()

    def done(self):
        if self.terminal:
            self.stream.write('\r\033[K')


running, stopped = set(), threading.Event()


def stop():
    """Ends all benches."""
    stopped.set()
    for bench in list(running):
        bench.kill()


def run(program, arguments, log, progress):
    """Runs a bench to its end, its words into `log`."""
    bench = subprocess.Popen([str(program), *arguments], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, errors='replace')
    running.add(bench)
    if stopped.is_set():
        bench.kill()
    last = ''
    try:
        for line in bench.stdout:
            log.write(line)
            last = line.strip() or last
            progress.tell(last)
    except BaseException:
        bench.kill()
        raise
    finally:
        code = bench.wait()
        running.discard(bench)
    if code != 0:
        raise Refused('%s %s: ended with code %d: %s'
                      % (program.name, ' '.join(arguments), code, last))
