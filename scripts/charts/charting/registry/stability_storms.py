# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Bends of the default in a storm, over step and spread of stiffness."""
import numpy as np

from charting import style
from charting.chart import Chart, sized
from charting.registry.stability_map import COLUMNS
from charting.tables import groups


def draw(rows):
    figure, (panels,) = style.figure('The default in a storm of 30 times the gust stays bounded: '
                                     'largest bend of any joint', 1, 2, size=(5.0, 4.2), sharey=True)
    for axes, (name, each) in zip(panels, groups(rows, 'method').items()):
        apart, steps = (np.array(sorted({row[key] for row in each})) for key in 'xy')
        order = sorted(each, key=lambda row: (row.x, row.y))
        bends = np.array([row.theory for row in order]).reshape(len(apart), len(steps))
        shown = axes.pcolormesh(style.edges_of(np.log10(1e3 * steps)),
                                style.edges_of(np.log10(apart)), bends, cmap='viridis',
                                vmin=0.0, vmax=3.0, rasterized=True)
        broken = [row for row in each if not np.isfinite(row.theory)]
        axes.plot([np.log10(1e3 * row.y) for row in broken],
                  [np.log10(row.x) for row in broken], 'rx')
        axes.axvline(np.log10(1e3 / 240), color='white', linestyle=':')
        style.note(axes, np.log10(1e3 / 240), np.log10(apart[0]), 'step of the nodes', offset=(4, 4),
                   color='white')
        style.label(axes, 'log10 of the step [ms]', 'log10 of the stiffest joint over the softest',
                    f'{name}: {len(broken)} of {len(each)} not finite')
    figure.colorbar(shown, ax=panels[-1]).set_label('largest bend [rad]; joints stop at 3')
    return figure


SOURCES = ('src/dynamics', 'bench/stability_bench.cpp')
ADVICE = ('Choose the default for any step and stiffness, in single or double precision: '
          'no bend exceeds the stop of a joint.')
CHART = Chart('stability_storms', 'the default in a storm over step and spread of stiffness', ADVICE,
              'stability_bench', COLUMNS, draw, SOURCES, sized('--part', 'storms'))
