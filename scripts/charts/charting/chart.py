# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The description of a chart."""
from dataclasses import dataclass, field
from typing import Callable, Dict, List, Tuple

EXTENTS = ('quick', 'usual', 'full')


class RequestError(Exception):
    """A request that cannot be carried out; the text names the fault."""


@dataclass(frozen=True)
class Chart:
    """A drawing of one table that a bench writes with `--csv`."""
    name: str  # of its files and for --only
    about: str  # a description in one line
    advice: str  # what a user should choose by it, in a sentence or two below the drawing
    bench: str  # program of this package
    columns: Dict[str, type]  # of the table, in its order: str or float
    draw: Callable  # rows -> figure
    # Files, and folders with their headers, after whose change the chart has to be made again.
    sources: Tuple[str, ...]
    # Arguments of each run of the bench, by extent; the rows of all runs form one table. The default
    # is one run, whose length the bench adapts to the extent.
    runs: Dict[str, List[List[str]]] = field(default_factory=lambda: {
        'quick': [['--quick']], 'usual': [[]], 'full': [['--full']]})
    cached: bool = False  # the bench keeps converged references in the folder of `--cache`


def sized(*arguments):
    """Returns one run with these arguments, whose length the bench adapts to the extent."""
    return {'quick': [['--quick', *arguments]], 'usual': [[*arguments]],
            'full': [['--full', *arguments]]}
