# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What became of the faults."""
from collections import Counter, defaultdict

LIMIT = 2.0  # [s] of wall time until a fault is named


class Outcomes:
    """Counts faults, and the times until the diagnostics named them."""

    def __init__(self):
        self.injected = Counter()       # kinds of faults
        self.times = defaultdict(list)  # by kind [s]; None: never
        self.unnamed = Counter()        # kind, node and words
        self.winds_kept = self.winds_changed = 0  # when wind_broadcaster was killed
        self.requests = self.refused = self.unanswered = 0
        self.credulous = set()  # services that refused none of the bad requests
        self.warm_since = None  # time of the clock from which memory is measured [s]
        self.rests = []         # begin and end of the times in which it is measured [s]

    def add(self, fault, node, words, took):
        self.injected[fault] += 1
        self.times[fault].append(took)
        if took is None or took > LIMIT:
            self.unnamed[fault, node, words] += 1
            print('  not named in time: %s of %s by "%s"%s' % (
                fault, node, words, '' if took is None else ', but after %.1f s' % took), flush=True)

    def slowest(self, fault):
        return max([took for took in self.times[fault] if took is not None], default=0.0)

    def count_unnamed(self, fault):
        return sum(count for (kind, _, _), count in self.unnamed.items() if kind == fault)

    def add_wind(self, winds, number):
        """Compares the first wind after a kill, of this number, with the last one before."""
        kept = len(winds) > number and winds[number] == winds[number - 1]
        self.winds_kept += kept
        self.winds_changed += not kept
