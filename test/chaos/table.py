# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The table of checks that the chaos test prints at its end."""


class Table:
    """Rows of a check, its figure, its bar and whether it holds."""

    def __init__(self):
        self._rows, self.failures = [], 0

    def add(self, check, figure, bar='', holds=True):
        self._rows.append((check, figure, bar, ('ok' if holds else 'FAILED') if bar else ''))
        self.failures += not holds

    def show(self):
        rows = [('check', 'figure', 'bar', '')] + self._rows
        widths = [max(len(row[column]) for row in rows) for column in range(4)]
        for row in rows:
            print('  '.join(text.ljust(width) for text, width in zip(row, widths)).rstrip())
