# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A tree in modes: error against full dynamics by their number, beside the other tiers."""
from charting import ladders, style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'load': str, 'branches': float, 'model': str, 'modes': float, 'vectors': float,
           'error': float, 'first_mm': float, 'cost_ns': float, 'find_ms': float, 'kb': float}
LOADS = ('gust', 'pull', 'breeze, oak', 'breeze, willow')
DEFAULT = (8.0, 6.0)  # forest::ModalDepth
VECTORS = {0.0: ('modes alone', style.BLUE, 'o'), 1.0: ('and 1 vector of the load', style.RED, 's'),
           2.0: ('and 2 vectors', style.ORANGE, 'v'), 5.0: ('and 5 vectors', style.WINE, '^'),
           6.0: ('and 6 vectors', style.GREEN, 'P'), 10.0: ('and 10 vectors', style.SKY, 'D')}
OTHERS = {'procedural': ('procedural', style.PINK, 'h'),
          'paper dynamics': ("paper's dynamics, 240 Hz", style.GREY, 'X'),
          'full chain': ('full chain, 240 Hz', style.BLACK, '*')}


def draw(rows):
    loads = [name for name in LOADS if any(row.load == name for row in rows)]
    figure, panels = style.figure(
        'A tree in modes (numbers: how many), beside procedural motion and the full chain',
        (len(loads) + 1) // 2, 2, size=(5.2, 4.0))
    panels = [axes for line in panels for axes in line]
    for axes, load in zip(panels, loads):
        draw_load(axes, load, [row for row in rows if row.load == load])
    for axes in panels[len(loads):]:
        axes.set_visible(False)
    style.legend_below(figure, panels[:len(loads)], 4)
    return figure


def setting(row):
    return '%d' % row.modes


def draw_load(axes, load, rows):
    branches = max(row.branches for row in rows)
    own = [type(row)(row, error=100.0 * row.error,
                     chosen=(row.modes, row.vectors) == DEFAULT)
           for row in rows if row.branches == branches]
    modal = [row for row in own if row.model == 'modes']
    for vectors, tiers in groups(modal, 'vectors').items():
        tiers = sorted(tiers, key=lambda row: row.modes)
        name, colour, marker = VECTORS[vectors]
        axes.loglog([row.cost_ns for row in tiers], [row.error for row in tiers], '-',
                    marker=marker, color=colour, label=name)
    for row in own:
        if row.model in OTHERS:
            name, colour, marker = OTHERS[row.model]
            axes.loglog([row.cost_ns], [row.error], marker, color=colour, markersize=9, label=name)
        if row.chosen:
            style.ring(axes, row.cost_ns, row.error, ladders.name_of_default(row, setting), left=True)
    style.draw_front(axes, [(row.cost_ns, row.error) for row in own])
    axes.margins(x=0.12, y=0.12)
    ladders.write_settings(axes, [(row, row.cost_ns, row.error) for row in modal],
                           setting, left=True)
    finding = max(row.find_ms for row in own)
    if finding > 0.0:
        axes.text(0.98, 0.98, 'modes are computed first, in up to %.2g ms' % finding, ha='right',
                  va='top', transform=axes.transAxes, fontsize=7.5)
    style.label(axes, 'processor time beside that of poses [ns per branch and frame]',
                'error of the tips, rms [% of their motion]',
                '%s, %d branches' % (load, branches))


SOURCES = ('src/dynamics', 'bench/modal', 'bench/trees', 'bench/modal_bench.cpp')
ADVICE = ('Choose 8 modes and 6 vectors of the load (default) for near trees, procedural '
          'motion, which computes no modes first, for far ones, and the full chain for '
          'what is touched.')
CHART = Chart('modal_ladder', 'error and cost of a tree in modes', ADVICE, 'modal_bench', COLUMNS,
              draw, SOURCES,
              cached=True)
