# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""How many branches of a pulled tree are physical: error of the pulled tip against cost."""
from charting import ladders, style
from charting.chart import Chart
from charting.tables import groups


def draw(rows):
    depths = sorted({row.ladder.split()[1] for row in rows})
    figure, (panels,) = style.figure(
        'Which branches become physical, the rest being rigid clusters: an oak of 532, pulled by 20 N', 1,
        len(depths), size=(4.4, 4.4), sharey=True)
    of = groups(rows, 'ladder')
    for axes, depth in zip(panels, depths):
        own = [type(row)(row, cost=1e6 * row.cost, error=100.0 * row.error)
               for name in ('influence', 'depth') for row in of['%s %s' % (name, depth)]]
        ladders.draw(axes, own, names=lambda name: {
            'influence': 'by predicted influence, tolerance', 'depth': "the paper's rule: by depth",
        }[name.split()[0]], setting=lambda row: label(row), floor=1e-2)
        axes.margins(x=0.2)
        style.label(axes, 'processor time of a tick of 1/60 s [µs]',
                    'error of the pulled tip, rms [% of its motion]' if depth == depths[0] else '',
                    'at a branch of depth ' + depth)
    style.legend_below(figure, panels, 3)
    return figure


def label(row):
    if row.ladder.startswith('depth'):
        return '%d branches' % row.rung
    return '%g mm' % (1e3 * float(row.setting))


CHART = Chart('influence_ladder', 'error and cost of making some branches physical',
              'influence_bench', ladders.COLUMNS, draw)
