# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A tree in modes: error against full dynamics by how many, beside the other rungs."""
from charting import ladders, style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'load': str, 'branches': float, 'model': str, 'modes': float, 'vectors': float,
           'error': float, 'first_mm': float, 'cost_ns': float, 'find_ms': float, 'kb': float}
DEFAULT = (4.0, 5.0)  # forest::ModalDepth
NAMES = {0.0: 'modes alone', 1.0: 'modes and 1 vector of the load',
         5.0: 'modes and 5 vectors of the load', 10.0: 'modes and 10 vectors of the load',
         -1.0: 'procedural'}


def draw(rows):
    loads = [name for name in ('gust', 'pull', 'breeze, oak', 'breeze, willow')
             if any(row.load == name for row in rows)]
    figure, panels = style.figure('A tree in modes, beside the procedural and the physical rungs',
                                  (len(loads) + 1) // 2, 2, size=(5.2, 4.0))
    panels = [axes for line in panels for axes in line]
    for axes, load in zip(panels, loads):
        draw_load(axes, load, [row for row in rows if row.load == load])
    for axes in panels[len(loads):]:
        axes.set_visible(False)
    style.legend_below(figure, panels[:len(loads)], 3)
    return figure


def draw_load(axes, load, rows):
    branches = max(row.branches for row in rows)
    own = [row for row in rows if row.branches == branches]
    curves = [rung(row) for row in own if row.model in ('modes', 'procedural')]
    ladders.draw(axes, sorted(curves, key=lambda row: row.ladder), names=lambda name: name,
                 setting=lambda row: row.setting)
    for model, marker in (('paper dynamics', 'X'), ('full chain', '*')):
        for row in own:
            if row.model == model:
                axes.plot([row.cost_ns], [100.0 * row.error], marker, color=style.BLACK,
                          markersize=8, label=model + ', 240 Hz', linestyle='none')
    axes.margins(x=0.12, y=0.12)
    style.label(axes, 'cost beside forward kinematics [ns a branch and frame]',
                'error of the tips, rms [% of their motion]',
                '%s, %d branches' % (load, branches))


def rung(row):
    modal = row.model == 'modes'
    return type(row)(ladder=NAMES.get(row.vectors, '%d vectors' % row.vectors), cost=row.cost_ns,
                     error=100.0 * row.error, setting='%d' % row.modes if modal else '',
                     chosen=float((row.modes, row.vectors) == DEFAULT))


CHART = Chart('modal_ladder', 'error and cost of a tree in modes', 'modal_bench', COLUMNS, draw,
              cached=True)
