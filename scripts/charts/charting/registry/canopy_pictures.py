# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of layers, warped on grids, against every leaf: error in pixels and cost by layers."""
from charting import style
from charting.chart import Chart, sized

SHIFTS = {'0.0 m': 'eye still', '0.3 m': 'eye has moved by 0.3 m', '1.0 m': 'eye has moved by 1 m'}
CHOSEN = 5
COSTS = {'grids': 'moving the grids of all layers', 'leaves': 'moving 9 000 leaves'}


def draw(rows):
    figure, ((error, cost),) = style.figure(
        'Fifteen shrubs at 12 m as pictures of their layers, against every leaf', 1, 2, size=(4.6, 3.8))
    for number, (shift, name) in enumerate(SHIFTS.items()):
        own = [row for row in rows if row.what == 'pictures, ' + shift]
        predicted = [row for row in rows if row.what == 'predicted, ' + shift]
        error.plot([row.size for row in own], [row.value for row in own],
                   '-' + style.MARKERS[number], color=style.COLOURS[number], label=name)
        error.plot([row.size for row in predicted], [row.value for row in predicted], ':',
                   color=style.COLOURS[number], label='predicted, dotted' if number == 0 else None)
        for row in own:
            if row.size == CHOSEN and number == 2:
                style.ring(error, row.size, row.value)
    for number, (what, name) in enumerate(COSTS.items()):
        own = [row for row in rows if row.what == 'cost, ' + what]
        cost.plot([row.size for row in own], [row.value for row in own],
                  '-' + style.MARKERS[number], color=style.COLOURS[number], label=name)
    for axes in (error, cost):
        axes.set_ylim(bottom=0.0)
        axes.legend()
    style.label(error, 'layers', 'error of tips of leaves, rms [pixel]')
    style.label(cost, 'layers', 'processor time of a frame [ms]')
    return figure


SOURCES = ('src/canopy/layers', 'src/canopy/layer_grid.cpp', 'src/canopy/leaf_motion.cpp',
           'bench/canopy_bench.cpp', 'scenes/canopy')
ADVICE = ('Choose pictures of 5 layers (default): within about 1 pixel once the eye has '
          'moved by 1 m, at a fraction of the time of every leaf.')
CHART = Chart('canopy_pictures', 'error and cost of pictures of layers against every leaf', ADVICE,
              'canopy_bench', {'what': str, 'size': float, 'value': float, 'ratio': float},
              draw, SOURCES,
              sized('--part', 'pictures'))
