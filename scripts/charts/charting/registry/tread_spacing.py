# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Spacing of the nodes of trodden ground: error of the blades against time and memory."""
from charting import ladders, style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'source': str, 'spacing': float, 'step_us': float, 'memory_kb': float,
           'height': float, 'tip': float, 'wrong': float, 'chosen': float}
NAMES = {'walker': 'walker, crushes a track of 32 cm', 'wheel': 'wheel, crushes a track of 20 cm'}
COSTS = {'step_us': 'processor time of a step of 1/60 s [µs]',
         'memory_kb': 'memory of trodden ground [kB/m²]'}


def setting(row):
    return '%.3g cm' % (100.0 * row.spacing)


def draw_cost(axes, rows, cost):
    """Draws the error against one cost, a curve for each source."""
    points = [(row, row[cost], 1e3 * row.height) for row in rows]
    for number, (source, own) in enumerate(groups(rows, 'source').items()):
        axes.loglog([row[cost] for row in own], [1e3 * row.height for row in own], '-',
                    marker=style.MARKERS[number], color=style.COLOURS[number],
                    label=NAMES[source])
    for row, x, y in points:
        if row.chosen:
            style.ring(axes, x, y, ladders.name_of_default(row, setting))
    axes.margins(x=0.12)
    ladders.write_settings(axes, points, setting, False)


def draw(rows):
    figure, (panels,) = style.figure(
        'Spacing of the nodes of trodden grass (at the points) under a walker and a wheel', 1, 2,
        size=(5.4, 4.4), sharey=True)
    for axes, (cost, name) in zip(panels, COSTS.items()):
        draw_cost(axes, rows, cost)
        style.label(axes, name, 'error of the height of blades of 30 cm, rms [mm]'
                    if axes is panels[0] else '')
    style.legend_below(figure, panels, 3)
    return figure


SOURCES = ('src/grass/tread', 'src/grass/blades', 'bench/tread_bench.cpp')
ADVICE = ('Choose 5 cm (default), which is off by 2 cm at most; choose 2.5 cm under narrow wheels, '
          'for two to three times the memory, or 12.5 cm under people alone, for a third of it.')
CHART = Chart('tread_spacing', 'error and cost of the spacing of nodes of trodden ground', ADVICE,
              'tread_bench', COLUMNS, draw, SOURCES)
