# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""How many branches of a pulled tree are physical: error of the pulled tip against cost."""
from charting import ladders, style
from charting.chart import Chart
from charting.tables import groups


NAMES = {'influence': 'in clusters beyond a predicted influence',
         'depth': "in clusters beyond a depth, the paper's rule",
         'all': 'without clusters: the reference, drawn at 0.01 %'}
FLOOR = 1e-2  # at which an error of zero is drawn [%]


def draw(rows):
    depths = sorted({row.ladder.split()[1] for row in rows})
    figure, (panels,) = style.figure(
        'Physical branches of an oak of 532 that is pulled by 20 N; the others move in rigid clusters',
        1, len(depths), size=(4.4, 4.4), sharey=True)
    of = groups(rows, 'ladder')
    for axes, depth in zip(panels, depths):
        own = [type(row)(row, cost=1e6 * row.cost, error=100.0 * row.error)
               for name in NAMES for row in of['%s %s' % (name, depth)]]
        ladders.draw(axes, own, names=lambda name: NAMES[name.split()[0]], setting=label,
                     floor=FLOOR)
        axes.margins(x=0.3)
        style.label(axes, 'processor time of a tick of 1/60 s [µs]',
                    'error of the pulled tip, rms [% of its motion]' if depth == depths[0] else '',
                    'at a branch of depth ' + depth)
    style.legend_below(figure, panels, 3)
    return figure


def label(row):
    if not row.ladder.startswith('influence'):
        return '%d branches' % row.tier
    return '%g mm' % (1e3 * float(row.setting))


SOURCES = ('src/tree/physical', 'src/dynamics', 'bench/influence_bench.cpp')
ADVICE = ('Choose an influence of 5 mm (default), 0.5 mm for an error of a few per cent, '
          'and all branches for references only.')
CHART = Chart('influence_ladder', 'error and cost of making some branches physical', ADVICE,
              'influence_bench', ladders.COLUMNS, draw, SOURCES)
