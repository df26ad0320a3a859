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
        'Ever more trees in a breeze on one budget', 1, 3, size=(4.4, 4.0))
    trees = [row.trees for row in rows]
    costs.loglog(trees, [row.asked_ms for row in rows], 'o--', color=style.GREY,
                 label='what the tolerance asks for')
    costs.loglog(trees, [row.cost_ms for row in rows], 's-', color=style.BLUE,
                 label='what the governor chose, by the estimate that the budget limits')
    costs.fill_between(trees, [row.least_ms for row in rows], [row.cost_ms for row in rows],
                       color=style.BLUE, alpha=0.25)
    costs.loglog(trees, [row.choice_ms for row in rows], '^-', color=style.ORANGE,
                 label='choosing, and the state message')
    costs.loglog(trees, [row.poses_ms for row in rows], 'D-', color=style.GREEN,
                 label='posing what it chose, measured')
    costs.set_ylim(top=50.0)  # the legend has room
    bound(costs, rows, rows[0].budget_ms, 'budget')
    style.label(costs, 'trees', 'processor time of a frame [ms]', 'cost')
    errors.loglog(trees, [row.error_px for row in rows], 'D-', color=style.RED,
                  label='largest of all trees')
    errors.loglog(trees, [row.median_px for row in rows], 'v-', color=style.BLUE,
                  label='of the median tree that moves')
    bound(errors, rows, 1.0, 'tolerance')
    style.label(errors, 'trees', 'predicted error [pixel]', 'error')
    changes.semilogx(trees, [row.changes for row in rows], 'o-', color=style.BLUE,
                     label='of the tree that changes most')
    changes.set_ylim(0.0, 1.3)
    bound(changes, rows, 1.0, 'required: below')
    style.label(changes, 'trees', 'changes of tier per second', 'changes in a steady breeze')
    for axes in (costs, errors, changes):
        axes.legend()
    return figure


SOURCES = ('src/core/lod', 'src/tree/lod', 'src/forest/detail', 'bench/governor_bench.cpp')
CHART = Chart('governor', 'ever more trees on one budget', 'governor_bench', COLUMNS, draw, SOURCES,
              sized('--part', 'budget'))
