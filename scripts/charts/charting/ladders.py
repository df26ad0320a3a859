# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws ladders: the error of each tier against its cost.

Benches write them with the columns LADDER_COLUMNS of bench/table.h.
"""
from charting import style
from charting.tables import groups

COLUMNS = {'ladder': str, 'tier': float, 'setting': str, 'cost': float, 'error': float,
           'chosen': float}


def draw(axes, rows, names=lambda ladder: ladder, setting=None, floor=None, left=False):
    """Draws one curve per ladder, the Pareto front of all, and a ring around the default.

    `setting` is a function from a row to the words at its point. Errors below `floor` are drawn at
    it. With `left`, the word "default" stands on the left of its point.
    """
    points = []
    for number, (ladder, tiers) in enumerate(groups(rows, 'ladder').items()):
        tiers = sorted(tiers, key=lambda row: row.cost)
        errors = [max(row.error, floor) if floor else row.error for row in tiers]
        costs = [row.cost for row in tiers]
        points += [(row, cost, error) for row, cost, error in zip(tiers, costs, errors)]
        axes.loglog(costs, errors, '-', marker=style.MARKERS[number],
                    color=style.COLOURS[number], label=names(ladder))
    for row, cost, error in points:
        if row.chosen:
            style.ring(axes, cost, error, name_of_default(row, setting), left)
    if setting:
        write_settings(axes, points, setting, left)
    style.draw_front(axes, [(cost, error) for _, cost, error in points])


def name_of_default(row, setting):
    return 'default' + (': ' + setting(row) if setting else '')


def write_settings(axes, points, setting, left):
    """Writes words beside the points where they cover no other point or words."""
    axes.autoscale_view()
    at = axes.transData.transform([point[1:] for point in points])
    taken = [style.box(x, y) for x, y in at]
    taken += [style.box_of_words(*place, name_of_default(point[0], setting), (-9 if left else 9, 9),
                                 bold=True)
              for place, point in zip(at, points) if point[0].chosen]
    said = set()
    for place, (row, cost, error) in zip(at, points):
        text = setting(row)
        spot = (text, round(place[0] / 20.0), round(place[1] / 40.0))  # once where two curves meet
        if spot in said:
            continue
        said.add(spot)
        boxes = [(offset, style.box_of_words(*place, text, offset)) for offset in style.BESIDE]
        free = [each for each in boxes if not any(style.overlap(each[1], box) for box in taken)]
        if free and not row.chosen:
            offset, box = free[0]
            taken.append(box)
            style.note(axes, cost, error, text, offset, ha='left' if offset[0] > 0 else 'right')
