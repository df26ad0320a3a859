# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Levels of procedural motion: visible error against time of a frame."""
from charting import ladders, style
from charting.chart import Chart, sized


def draw(rows):
    figure, ((axes,),) = style.figure('Levels of procedural motion of a forest', size=(7.6, 4.8))
    in_ms = [type(row)(row, cost=1e3 * row.cost) for row in rows]
    ladders.draw(axes, in_ms, floor=5e-3, names={
        'one level for all': 'one depth of branches for all trees (0 to 6)',
        'by tolerance': "each tree's own depth, by tolerance [pixel]"}.get,
        setting=lambda row: '%g' % float(row.setting))
    style.label(axes, 'processor time of a frame, choice of levels included [ms]',
                'largest error of a branch tip in the picture [pixel]')
    axes.axhline(1.0, color='0.5', linewidth=0.8, linestyle=':',
                 label='tolerance of the default')
    axes.legend()
    return figure


SOURCES = ('src/tree/lod', 'src/tree/motion', 'bench/forest_bench.cpp')
ADVICE = ("Choose each tree's own depth by a tolerance of 1 pixel (default); choose one "
          'depth of 4 only where no error is allowed.')
CHART = Chart('level_ladder', 'error and cost of levels of procedural motion', ADVICE, 'forest_bench',
              ladders.COLUMNS, draw, SOURCES, sized('--part', 'levels'))
