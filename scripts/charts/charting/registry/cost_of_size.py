# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Cost of a frame over the number of objects, with the slope."""
import numpy as np

from charting import style
from charting.chart import Chart
from charting.tables import groups

NAMES = {'trees': 'trees: levels and state of a tick', 'branches': 'branches posed (procedural)',
         'physical': 'physical branches: a tick of 1/60 s',
         'links, plain': 'physical links: a step, plain', 'links, SIMD': 'the same on wide vectors',
         'blades': 'blades of grass posed', 'nodes': 'nodes of grass trodden',
         'walkers': 'walkers among ten trunks each: a tick of 1/60 s',
         'cells': 'cells of a leaf field: wind and leaves of 1/30 s'}
FRAME = 1.0 / 60.0


def slope(sizes, seconds):
    """Returns the exponent of the cost over the upper half of the sizes, on a logarithmic scale."""
    high = sizes >= np.sqrt(sizes.max())
    if high.sum() < 2:
        high = sizes > 0
    return np.polyfit(np.log(sizes[high]), np.log(seconds[high]), 1)[0]


def draw(rows):
    figure, ((axes,),) = style.figure('Cost against size', size=(8.6, 5.4))
    for number, (series, each) in enumerate(groups(rows, 'series').items()):
        each = sorted(each, key=lambda row: row.size)
        sizes = np.array([row.size for row in each])
        seconds = np.array([row.seconds for row in each])
        axes.loglog(sizes, 1e3 * seconds, marker=style.MARKERS[number % len(style.MARKERS)],
                    color=style.COLOURS[number % len(style.COLOURS)],
                    linestyle='-' if number < len(style.COLOURS) else '--',
                    label='%s\n  exponent %.2f, %s ns each at the end' % (
                        NAMES.get(series, series), slope(sizes, seconds),
                        float('%.2g' % (1e9 * seconds[-1] / sizes[-1]))))
    axes.axhline(1e3 * FRAME, color='0.3', linewidth=1.0)
    axes.annotate('a frame of 1/60 s', (0.01, 1e3 * FRAME), xycoords=('axes fraction', 'data'),
                  xytext=(4, 3), textcoords='offset points', fontsize=8)
    axes.set_ylim(top=40.0)
    style.label(axes, 'number of trees, branches, links, blades, nodes, walkers or cells', 'processor time, one core [ms]',
                'slope 1 is linear cost; exponents are fitted over the upper half')
    axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), labelspacing=1.0)
    return figure


SOURCES = ('src/tree', 'src/forest', 'src/grass', 'src/crowd', 'bench/size_bench.cpp')
ADVICE = ('Plan with costs that are linear: at 60 Hz one core bears some 40 000 physical branches, '
          '17 000 walkers or 80 000 cells of leaf fields with AVX2.')
CHART = Chart('cost_of_size', 'cost over the number of trees, branches, blades, nodes', ADVICE,
              'size_bench', {'series': str, 'size': float, 'seconds': float}, draw, SOURCES)
