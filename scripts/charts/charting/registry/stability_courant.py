# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Waves in a leaf field: growth of the shortest wave over Courant's number."""
from charting import style
from charting.chart import Chart
from charting.registry.stability_map import COLUMNS, panel
from charting.tables import groups

DEFAULT = 'exact, mode by mode (default)'


def draw(rows):
    maps = groups(rows, 'map')
    methods, edges = groups(maps['growth'], 'method'), groups(maps['edge'], 'method')
    names = [DEFAULT] + [name for name in methods if name != DEFAULT]
    figure, (panels,) = style.figure('Where waves in a leaf field break: growth of the shortest '
                                     'wave', 1, len(names), size=(4.0, 4.0), sharey=True)
    for axes, name in zip(panels, names):
        shown = panel(axes, methods[name], edges.get(name, []))
        axes.set_title(name, fontweight='bold' if name == DEFAULT else 'normal')
        axes.set_xlabel("leaves' own frequency times the step")
    panels[0].set_ylabel("Courant's number, speed of waves x step / cell")
    panels[1].text(0.97, 0.97, 'black: edge, by bisection\nyellow: edge by theory', ha='right',
                   va='top', transform=panels[1].transAxes, color='white', fontsize=8)
    figure.colorbar(shown, ax=panels[-1]).set_label('growth per step')
    return figure


SOURCES = ('src/canopy/flow', 'bench/courant_bench.cpp')
ADVICE = ('Choose the exact method (default), which is stable everywhere. Verlet costs '
          'less, but needs a Courant number below 0.7.')
CHART = Chart('stability_courant', "growth of waves in a leaf field over Courant's number", ADVICE,
              'courant_bench', COLUMNS, draw, SOURCES)
