# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Air in the plane of a leafy mass: error of each scheme, size and Courant number against cost."""
from charting import ladders, style
from charting.chart import Chart, sized
from charting.tables import Row

NAMES = {'reflection': 'advection-reflection', 'fast': 'one exact projection',
         'paper': "the paper's sweeps"}
CHOSEN = ('reflection', 64, 4.0)  # at the default 64 cells wind of 4 m/s crosses 2 cells a tick


def points(rows):
    """Yields the cost until the fastest air has crossed the square, and the error meanwhile."""
    step = {(row.what[len('air, '):], row.size): row.value for row in rows
            if row.what.startswith('air, ')}
    for row in rows:
        if not row.what.startswith('error, '):
            continue
        _, scheme, courant = row.what.split(', ')
        cells, number = row.size, float(courant.split()[1])
        yield Row(ladder=scheme, setting='%d, %g' % (cells, number), error=100.0 * row.value,
                  cost=step[scheme, cells] * cells / number,
                  chosen=float((scheme, cells, number) == CHOSEN))


def draw(rows):
    figure, ((axes,),) = style.figure('Air in the plane of a leafy mass', size=(7.6, 4.8))
    ladders.draw(axes, list(points(rows)), names=NAMES.get, setting=lambda row: row.setting)
    style.label(axes, 'processor time until the fastest air has crossed the square [ms]',
                'error of the flow after 0.25 s [%]',
                "at the points: cells along a side, Courant's number of the step")
    axes.legend()
    return figure


SOURCES = ('src/canopy/flow', 'src/canopy/plane', 'src/reference/canopy', 'bench/canopy_bench.cpp')
ADVICE = ('Choose advection-reflection on 64 cells (default), shorter steps for an error '
          'of 2 %, and one exact projection where 20 % is enough.')
CHART = Chart('fluid_ladder', 'error and cost of schemes and sizes of the air of leafy masses', ADVICE,
              'canopy_bench', {'what': str, 'size': float, 'value': float, 'ratio': float},
              draw, SOURCES,
              sized('--part', 'steps,errors'))
