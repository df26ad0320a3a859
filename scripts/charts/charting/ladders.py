# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Charts of ladders: the error of each rung against its cost. Benches write them in one form,
bench/table.h's LADDER_COLUMNS."""
import math

from charting import style
from charting.tables import groups

COLUMNS = {'ladder': str, 'rung': float, 'setting': str, 'cost': float, 'error': float,
           'chosen': float}


def draw(axes, rows, names=lambda ladder: ladder, setting=None, floor=None, left=False):
    """One curve a ladder, the front of all, the default ringed. `setting`: words at each point, a
    function of its row; `floor`: errors below are drawn there; `left`: "default" stands there."""
    points = []
    for number, (ladder, rungs) in enumerate(groups(rows, 'ladder').items()):
        rungs = sorted(rungs, key=lambda row: row.cost)
        errors = [max(row.error, floor) if floor else row.error for row in rungs]
        costs = [row.cost for row in rungs]
        points += [(row, cost, error) for row, cost, error in zip(rungs, costs, errors)]
        axes.loglog(costs, errors, '-', marker=style.MARKERS[number],
                    color=style.COLOURS[number], label=names(ladder))
    for row, cost, error in points:
        if row.chosen:
            style.ring(axes, cost, error, left=left)
    if setting:
        write_settings(axes, points, setting)
    style.draw_front(axes, [(cost, error) for _, cost, error in points])


def write_settings(axes, points, setting):
    """Words at the points, but not where they would cover those of another; the default has its
    own."""
    spans = [math.log(max(values) / min(values)) or 1.0 for values in list(zip(*points))[1:]]
    taken = [point for point in points if point[0].chosen]
    for row, cost, error in points:
        if any(abs(math.log(cost / other[1])) < 0.08 * spans[0] and
               abs(math.log(error / other[2])) < 0.04 * spans[1] for other in taken):
            continue
        taken.append((row, cost, error))
        style.note(axes, cost, error, setting(row))
