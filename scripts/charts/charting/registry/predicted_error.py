# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The errors that the choice of levels predicts, against measured ones, tree by tree."""
from charting import style
from charting.chart import Chart, sized
from charting.tables import groups

MODELS = {'procedural': 'in procedural motion', 'modes': 'in modes', 'fine modes': 'in fine modes'}
TOLERANCE = 1.0  # default [pixel]


def draw(rows):
    figure, ((axes,),) = style.figure('Largest error of each tree in the shipped scenarios',
                                      size=(6.4, 5.2))
    own = groups(rows, 'model')
    for number, (model, text) in enumerate(MODELS.items()):
        points = own.get(model, [])
        axes.loglog([row.predicted for row in points], [row.measured for row in points],
                    style.MARKERS[number], color=style.COLOURS[number], alpha=0.6, markersize=4,
                    label='%s (%d)' % (text, len(points)))
    ends = [min(min(row.predicted, row.measured) for row in rows),
            max(max(row.predicted, row.measured) for row in rows)]
    axes.loglog(ends, ends, '-', color=style.BLACK, linewidth=1.0, label='equal')
    for factor in (0.5, 2.0):
        axes.loglog(ends, [factor * end for end in ends], '--', color=style.GREY, linewidth=0.8,
                    label='twice or half' if factor == 2.0 else None)
    axes.axhline(TOLERANCE, color='0.5', linewidth=0.8, linestyle=':', label='default tolerance')
    within = sum(0.5 * row.measured <= row.predicted <= 2.0 * row.measured for row in rows)
    above = sum(row.measured > TOLERANCE for row in rows)
    style.label(axes, 'predicted error [pixel]', 'error measured against physical joints [pixel]',
                '%.0f %% of %d trees within a factor of 2; %.0f %% above the tolerance at some time'
                % (100.0 * within / len(rows), len(rows), 100.0 * above / len(rows)))
    axes.legend()
    return figure


SOURCES = ('src/tree', 'src/forest', 'scenes/forest/prediction_scene.h', 'bench/frame',
           'bench/governor_bench.cpp')
ADVICE = ('Choose the tolerance that a use requires: nearly all trees err less than predicted. Kelp in '
          'water errs up to three times as much; trees beyond the tolerance need a larger budget.')
CHART = Chart('predicted_error', 'predicted against measured errors of trees', ADVICE,
              'governor_bench', {'scenario': str, 'tree': float, 'model': str, 'predicted': float,
                                 'measured': float}, draw, SOURCES, sized('--part', 'scenarios'))
