# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the rigs of all nodes with a clock share."""
from diagnostic_msgs.msg import DiagnosticArray

from forest_rig import Log, listens
from waiting import DEADLINE, wait_for


class WatchedNode:
    """A node as its users see it. It has `logs`, and a persistent service `probe` that changes
    nothing when it is called without arguments."""

    def __init__(self, name, status, probe, logs):
        self.name = name
        self.process = name  # node that it lives in: a manager's, of a nodelet
        self._status = name.lstrip('/') + ': ' + status
        self._probe = probe
        self._logs = logs

    def wait_until_up(self, *topics):
        """Until it listens to the clock and `topics`, and its first state will be heard here."""
        self._probe.wait_for_service(DEADLINE)
        self.settle()
        for topic in ('/clock',) + topics:
            wait_for(lambda: listens(self.process, topic), '%s to hear %s' % (self.name, topic))
        for log in self._logs:
            wait_for(log.connected, log.topic)

    def settle(self):
        """Returns when it has taken all that was published before: it reads its sockets in turns,
        so what lay in another socket at the first call is in its queue by the second."""
        for _ in range(2):
            self._probe()

    def diagnostics(self):
        """The node's next diagnostics, by key."""
        log = Log('/diagnostics', DiagnosticArray)
        log.wait(lambda all: any(s.name == self._status for m in all for s in m.status), self._status)
        log.close()
        status = [s for m in log.messages for s in m.status if s.name == self._status][-1]
        return {pair.key: float(pair.value) for pair in status.values}

    def close(self):
        for log in self._logs:
            log.close()
        self._probe.close()
