# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ever more trees on one budget: their cost, their error, and how often tiers change."""
from charting import style
from charting.chart import Chart, sized

COLUMNS = {'trees': float, 'budget_ms': float, 'asked_ms': float, 'least_ms': float,
           'cost_ms': float, 'error_px': float, 'median_px': float, 'changes': float,
           'choice_ms': float, 'poses_ms': float}


def bound(axes, rows, value, text, **options):
    axes.axhline(value, color=style.BLACK, linewidth=0.8, linestyle=':')
    style.note(axes, rows[-1].trees, value, text, offset=(0, 4), ha='right', **options)


def draw(rows):
    figure, ((costs, errors, changes),) = style.figure(
        'Ever more trees in a breeze: frame_time %g ms, tolerance 1 pixel' % rows[0].budget_ms, 1, 3, size=(4.4, 4.0))
    trees = [row.trees for row in rows]
    costs.loglog(trees, [row.asked_ms for row in rows], 'o--', color=style.GREY,
                 label='cost that the tolerance asks for')
    costs.loglog(trees, [row.cost_ms for row in rows], 's-', color=style.BLUE,
                 label='cost that the governor chose, by its estimate')
    costs.fill_between(trees, [row.least_ms for row in rows], [row.cost_ms for row in rows],
                       color=style.BLUE, alpha=0.25)
    costs.loglog(trees, [row.choice_ms for row in rows], '^-', color=style.ORANGE,
                 label='time to choose, and for the state message')
    costs.loglog(trees, [row.poses_ms for row in rows], 'D-', color=style.GREEN,
                 label='time to pose what it chose, measured')
    bound(costs, rows, rows[0].budget_ms, 'frame_time')
    style.label(costs, 'trees', 'processor time of a frame [ms]', 'cost')
    errors.loglog(trees, [row.error_px for row in rows], 'D-', color=style.RED,
                  label='error, largest of all trees')
    errors.loglog(trees, [row.median_px for row in rows], 'v-', color=style.BLUE,
                  label='error of the median tree that moves')
    bound(errors, rows, 1.0, 'tolerance')
    style.label(errors, 'trees', 'predicted error [pixel]', 'error')
    changes.semilogx(trees, [row.changes for row in rows], 'o-', color=style.BLUE,
                     label='changes of the tree that changes most')
    changes.set_ylim(0.0, 1.3)
    bound(changes, rows, 1.0, 'required: below')
    style.label(changes, 'trees', 'changes of model per second', 'changes in a steady breeze')
    style.legend_below(figure, (costs, errors, changes), 3)
    return figure


SOURCES = ('src/core/lod', 'src/tree/lod', 'src/forest/detail', 'bench/governor_bench.cpp')
ADVICE = ('Choose frame_time by the processor that is free: beyond it errors grow to 1.4 '
          'pixel in the median. Raise tolerance where fewer trees should move.')
CHART = Chart('governor', 'ever more trees on one budget', ADVICE, 'governor_bench', COLUMNS, draw, SOURCES,
              sized('--part', 'budget'))
