# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Finds and runs the package's benches."""
import os
import pathlib
import subprocess
import sys
import threading
import time

from charting.chart import RequestError

PACKAGE = 'vegetation_sim'
QUIET = 30.0  # time between lines where there is no terminal to rewrite one on [s]


def folders():
    """Returns the folders of the package's programs: that of this one, then each sourced space."""
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
    raise RequestError('%s: no such program in %s; build it, or source setup.bash of the space that has '
                  'it' % (name, ', '.join(map(str, folders()))))


class Progress:
    """Shows the last line of a bench's output, rewritten in place on a terminal.

    Shows nothing before show(), because several benches run at the same time.
    """

    def __init__(self, stream=sys.stdout):
        self.stream, self.terminal, self.shown = stream, stream.isatty(), False
        self.start = self.last = time.monotonic()

    def begin(self):
        self.start = time.monotonic()

    def seconds(self):
        return time.monotonic() - self.start

    def show(self):
        self.shown = True

    def report(self, line):
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
    """Kills all running benches."""
    stopped.set()
    for bench in list(running):
        bench.kill()


def run(program, arguments, log, progress):
    """Runs a bench to its end and writes its output into `log`."""
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
            progress.report(last)
    except BaseException:
        bench.kill()
        raise
    finally:
        code = bench.wait()
        running.discard(bench)
    if code != 0:
        raise RequestError('%s %s: ended with code %d: %s'
                      % (program.name, ' '.join(arguments), code, last))
