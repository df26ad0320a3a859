# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The processes of the nodes, which one roslaunch has started, and when they were disturbed."""
import os
import re
import signal
import time

from waiting import wait_for

ANONYMOUS = re.compile(rb'RssAnon:\s*(\d+) kB')
RECOVERY = 3.0   # [s] of wall time in which a node catches up after it was stopped or lost


def _read(path):
    try:
        with open(path, 'rb') as file:
            return file.read()
    except OSError:  # the process has ended
        return b''


def _parent_and_state(process):
    fields = _read('/proc/%s/stat' % process).rpartition(b')')[2].split()
    return (int(fields[1]), fields[0]) if fields else (0, b'')


class Processes:
    """Finds and signals the children of one roslaunch."""

    def __init__(self, launcher):
        self._launcher = launcher
        self.disturbed = []  # node, begin and end of wall time; end is None while it lasts

    def find(self, node):
        """Returns the number of the process of a node, or None."""
        wanted = b'__name:=' + node.encode()
        for process in os.listdir('/proc'):
            if process.isdigit() and wanted in _read('/proc/%s/cmdline' % process).split(b'\0'):
                parent, state = _parent_and_state(process)
                if parent == self._launcher and state != b'Z':
                    return int(process)
        return None

    def memory(self, node):
        """Returns process and anonymous memory [bytes] of a node, or None. Resident pages of files
        do not count: they are code that has run for the first time."""
        process = self.find(node)
        found = ANONYMOUS.search(_read('/proc/%s/status' % process)) if process else None
        return (process, 1024 * int(found.group(1))) if found else None

    def signal(self, node, number):
        process = wait_for(lambda: self.find(node), node)
        os.kill(process, number)
        return process

    def kill(self, node):
        """Ends the process of a node at once. Returns when it has ended."""
        process = self.signal(node, signal.SIGKILL)
        wait_for(lambda: _parent_and_state(process)[1] in (b'', b'Z'), 'the end of ' + node)

    def begin(self, node):
        """Notes that a node is disturbed from now on."""
        entry = [node, time.monotonic(), None]
        self.disturbed.append(entry)
        return entry

    def is_disturbed(self, node, begin, end):
        """Returns whether a node was disturbed, or recovered from it, at some time of an interval."""
        return any(name == node and since <= end and
                   (until is None or until + RECOVERY >= begin)
                   for name, since, until in self.disturbed)

    def is_disturbed_now(self, node):
        now = time.monotonic()
        return self.is_disturbed(node, now, now)
