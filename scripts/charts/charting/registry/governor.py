# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ever more trees on one budget: what they cost, and how far they are off."""
from charting import style
from charting.chart import Chart, sized

COLUMNS = {'trees': float, 'budget_ms': float, 'asked_ms': float, 'cost_ms': float,
           'error_px': float, 'choice_ms': float}


def draw(rows):
    figure, ((costs, errors),) = style.figure('Ever more trees in a breeze on one budget', 1, 2)
    trees = [row.trees for row in rows]
    costs.loglog(trees, [row.asked_ms for row in rows], 'o--', color=style.GREY,
                 label='what the tolerance asks for')
    costs.loglog(trees, [row.cost_ms for row in rows], 's-', color=style.BLUE,
                 label='what the governor chose')
    costs.loglog(trees, [row.choice_ms for row in rows], '^-', color=style.ORANGE,
                 label='choosing, and the state message')
    costs.axhline(rows[0].budget_ms, color=style.BLACK, linewidth=0.8, linestyle=':')
    style.note(costs, trees[0], rows[0].budget_ms, 'budget')
    style.label(costs, 'trees', 'processor time of a frame [ms]', 'cost')
    costs.legend()
    errors.loglog(trees, [row.error_px for row in rows], 'D-', color=style.RED,
                  label='largest predicted error of a tree')
    errors.axhline(1.0, color=style.BLACK, linewidth=0.8, linestyle=':')
    style.note(errors, trees[-1], 1.0, 'tolerance', offset=(0, 4), ha='right')
    style.label(errors, 'trees', 'pixel', 'error')
    errors.legend()
    return figure


CHART = Chart('governor', 'ever more trees on one budget', 'governor_bench', COLUMNS, draw,
              sized('--part', 'budget'))
