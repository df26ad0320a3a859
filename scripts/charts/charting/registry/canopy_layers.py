# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Layers of a leafy mass against leaves that move alone: error and cost by their number."""
from charting import style
from charting.chart import Chart, sized

NAMES = {'truth, alike': 'leaves all alike', 'truth, own': 'frequencies of their own, ±15 %'}
CHOSEN = 5


def draw(rows):
    figure, ((error, cost),) = style.figure(
        'A shrub of 5 000 leaves in layers, against every leaf on its own', 1, 2, size=(4.6, 3.8))
    for number, (what, name) in enumerate(NAMES.items()):
        own = [row for row in rows if row.what == what]
        error.plot([row.size for row in own], [100.0 * row.value for row in own],
                   '-' + style.MARKERS[number], color=style.COLOURS[number], label=name)
        for row in own:
            if row.size == CHOSEN and number == 0:
                style.ring(error, row.size, 100.0 * row.value)
                style.ring(cost, row.size, row.ratio)
        if number == 0:
            cost.plot([row.size for row in own], [row.ratio for row in own], '-o',
                      color=style.BLUE, label='plane, layers and all leaves')
    slow = [row.ratio for row in rows if row.what == 'truth, cost']
    cost.axhline(sum(slow) / len(slow), color=style.BLACK, linestyle='--',
                 label='every leaf on its own')
    for axes in (error, cost):
        axes.set_ylim(bottom=0.0)
        axes.legend()
    style.label(error, 'layers', 'error, rms [% of the motion about its mean]')
    style.label(cost, 'layers', 'processor time of a tick of 1/30 s [ms]')
    return figure


SOURCES = ('src/canopy/layers', 'src/canopy/flow', 'src/canopy/plane', 'bench/canopy_bench.cpp')
ADVICE = ('Choose 5 layers (default). 9 layers lower the error from 39 to 29 % for more time; every '
          'leaf on its own costs several times as much.')
CHART = Chart('canopy_layers', 'error and cost of layers against every leaf on its own', ADVICE,
              'canopy_bench', {'what': str, 'size': float, 'value': float, 'ratio': float},
              draw, SOURCES,
              sized('--part', 'truth'))
