# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Growth per step of one joint over damping and step, the theory's edge drawn over it."""
import numpy as np
from matplotlib.colors import TwoSlopeNorm

from charting import style
from charting.chart import Chart, sized
from charting.tables import groups

COLUMNS = {'map': str, 'method': str, 'x': float, 'y': float, 'value': float, 'theory': float}
DEFAULT = 'midpoint (default)'


def panel(axes, growth, edge):
    """Draws growth over x and y as colour, and the edge, measured and by theory."""
    x, y = (np.array(sorted({row[key] for row in growth})) for key in 'xy')
    order = sorted(growth, key=lambda row: (row.x, row.y))
    values = np.array([row.value for row in order]).reshape(len(x), len(y)).T
    shown = axes.pcolormesh(style.edges_of(x), style.edges_of(y), np.clip(values, 0.5, 1.5),
                            cmap='RdBu_r', rasterized=True, norm=TwoSlopeNorm(1.0, 0.5, 1.5))
    for column, line in (('y', dict(color=style.BLACK, linewidth=3.0)),
                         ('theory', dict(color=style.YELLOW, linewidth=1.4, linestyle='--'))):
        axes.plot(*zip(*[(row.x, row[column]) for row in edge]), **line)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    return shown


def draw(rows):
    maps = groups(rows, 'map')
    methods, edges = groups(maps['growth'], 'method'), groups(maps['edge'], 'method')
    figure, panels = style.figure('Where methods break: one joint with frequency w [rad/s] and '
                                  'damping ratio D', 2, 3, size=(4.0, 3.5), sharex=True, sharey=True)
    order = [DEFAULT, 'implicit Euler', None, 'semi-implicit Euler', 'explicit Euler',
             'Runge-Kutta 4']
    shown = None
    for axes, name in zip(panels.flat, order):
        if name is None:
            explain(axes, 'Neither implicit method has an edge.')
            continue
        shown = panel(axes, methods[name], edges.get(name, []))
        axes.set(xscale='log', yscale='log')
        axes.set_title(name, fontweight='bold' if name == DEFAULT else 'normal')
    for axes in (panels[0][0], panels[1][0]):
        axes.set_ylabel('step times w')
    for axes in panels[1]:
        axes.set_xlabel('damping ratio D')
    figure.colorbar(shown, ax=panels[:, 2], shrink=0.9).set_label('growth per step')
    return figure


def explain(axes, more):
    axes.axis('off')
    axes.text(0.02, 0.95, 'blue: motion decays\nwhite: it stays\n'
              'red: it grows, the method breaks\n\n'
              'black line: the edge, by bisection\nyellow dashes: the edge by theory\n'
              '(docs/physics.md)\n\n' + more, transform=axes.transAxes,
              va='top', fontsize=9)


SOURCES = ('src/dynamics', 'bench/stability_bench.cpp')
ADVICE = ('Choose a linearly implicit method, which is stable at every step. An explicit '
          'one needs steps below 2 / w, and far shorter ones where damping is strong.')
CHART = Chart('stability_map', 'growth per step over damping and step, theory over it', ADVICE,
              'stability_bench', COLUMNS, draw, SOURCES, sized('--part', 'growth'))
