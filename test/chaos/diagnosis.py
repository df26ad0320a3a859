# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Whether and when the diagnostics name a fault."""
import threading
import time
from collections import deque

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

PATIENCE = 5.0  # [s] of wall time; later names do not count
MOST_KEPT = 500


class Report:
    """A DiagnosticStatus of a node and its arrival [s of wall time]."""

    def __init__(self, status, arrival):
        self.node, _, self.part = status.name.partition(': ')
        self.is_warning = status.level >= DiagnosticStatus.WARN
        self.text = status.message
        self.values = {pair.key: pair.value for pair in status.values}
        self.arrival = arrival


class Diagnosis:
    """Keeps the newest reports of all nodes."""

    def __init__(self):
        self.jumps_back = 0  # of the clock, as the nodes report them
        self._reports = deque(maxlen=MOST_KEPT)
        self._news = threading.Condition()
        self._subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, self._on_message)

    def _on_message(self, message):
        now = time.monotonic()
        with self._news:
            for status in message.status:
                report = Report(status, now)
                self._reports.append(report)
                self.jumps_back += 'jumps back of the clock' in report.text
            self._news.notify_all()

    def newest(self, node, key):
        """Returns the newest report of a node that has a value of this name, or None."""
        with self._news:
            found = [report for report in self._reports
                     if report.node == node and key in report.values]
        return found[-1] if found else None

    def wait(self, node, test, since):
        """Waits for a report of a node after a wall time for which `test(report)` is true. Returns
        the time that it took [s], or None."""
        def find():
            return next((report for report in self._reports if report.node == node and
                         report.arrival >= since and test(report)), None)
        with self._news:
            found = self._news.wait_for(find, max(0.1, since + PATIENCE - time.monotonic()))
        return found.arrival - since if found else None


def warns_of(words):
    """Returns a test for a warning with these words."""
    return lambda report: report.is_warning and words in report.text
