# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Largest stable step over stiffness of a joint and over the size of a tree."""
import math

from charting import style
from charting.chart import Chart, sized
from charting.registry.stability_map import COLUMNS, DEFAULT
from charting.tables import groups

COLOURS = {'explicit Euler': style.RED, 'semi-implicit Euler': style.ORANGE,
           'Runge-Kutta 4': style.BLUE, DEFAULT: style.GREEN}


def draw(rows):
    maps = groups(rows, 'map')
    figure, ((joint, tree),) = style.figure('Largest stable step, measured by bisection', 1, 2,
                                            size=(5.8, 4.8))
    for name, each in groups(maps['stiffness'], 'method').items():
        joint.loglog([row.x for row in each], [1e3 * row.theory for row in each], '--',
                     color=COLOURS[name], label=name + ', theory')
        joint.loglog([row.x for row in each], [1e3 * row.y for row in each], 'o',
                     color=COLOURS[name], label=name + ', measured')
    style.label(joint, 'stiffness over inertia [1/s²]', 'step [ms]',
                'one joint, damping ratio 0.1')
    for name, each in groups(maps['trees'], 'method').items():
        colour, sizes = COLOURS[name], [row.x for row in each]
        tree.loglog(sizes, [1e3 * row.y for row in each], 'o' if name != DEFAULT else '^-',
                    color=colour, label=name + (', measured' if name != DEFAULT else
                                                ': stable as far as tried'))
        if all(map(math.isfinite, (row.theory for row in each))):
            tree.loglog(sizes, [1e3 * row.theory for row in each], '--', color=colour,
                        label=name + ", estimate by the nodes")
            tree.loglog(sizes, [1e3 * row.value for row in each], ':', color=colour,
                        label=name + ', proved bound')
    for axes in (joint, tree):
        axes.axhline(1e3 / 240.0, color='0.3', linewidth=1.0)
        axes.annotate("the node's step, 1/240 s", (0.02, 1e3 / 240.0),
                      xycoords=('axes fraction', 'data'), xytext=(0, -9),
                      textcoords='offset points', fontsize=7.5,
                      path_effects=style.HALO)
    style.label(tree, 'branches of a tree, damping ratio 0.1', 'step [ms]', 'whole trees')
    tree.set_ylim(top=2e4)
    joint.legend()
    tree.legend(ncol=2, fontsize=7, loc='upper right')
    return figure


SOURCES = ('src/dynamics', 'bench/stability_bench.cpp')
ADVICE = ('Choose the midpoint (default), stable at any step tried. At 1/240 s explicit '
          'Euler breaks on every tree, semi-implicit Euler beyond some 10 branches and '
          'Runge-Kutta 4 beyond some 100.')
CHART = Chart('stability_limits', 'largest stable step over stiffness and size', ADVICE,
              'stability_bench', COLUMNS, draw, SOURCES, sized('--part', 'joints,trees'))
