# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a chart is."""
from dataclasses import dataclass, field
from typing import Callable, Dict, List

EXTENTS = ('quick', 'usual', 'full')


class Refused(Exception):
    """Something asked for is not there or not right; the text names it."""


@dataclass(frozen=True)
class Chart:
    """One idea, drawn from one table that a bench writes with `--csv`."""
    name: str  # of its files, as --only takes it
    about: str  # in one line
    bench: str  # program of this package
    columns: Dict[str, type]  # of the table, in its order: str or float
    draw: Callable  # rows -> figure
    # Arguments of each run of the bench by extent: the rows of all runs make one table. The default
    # is one run, which the bench itself shortens or lengthens.
    runs: Dict[str, List[List[str]]] = field(default_factory=lambda: {
        'quick': [['--quick']], 'usual': [[]], 'full': [['--full']]})
    cached: bool = False  # the bench keeps converged references in a folder, `--cache`


def sized(*arguments):
    """One run a chart, with these arguments, shortened or lengthened by the bench itself."""
    return {'quick': [['--quick', *arguments]], 'usual': [[*arguments]],
            'full': [['--full', *arguments]]}
