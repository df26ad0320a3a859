# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the default does in a storm, over step and how far stiffness is apart."""
import numpy as np
from matplotlib.colors import LogNorm

from charting import style
from charting.chart import Chart, sized
from charting.registry.stability_map import COLUMNS
from charting.tables import groups


def draw(rows):
    figure, (panels,) = style.figure('The default after a storm of 30 times the gust: largest bend '
                                     'in the end', 1, 2, size=(5.0, 4.2), sharey=True)
    for axes, (name, each) in zip(panels, groups(rows, 'method').items()):
        apart, steps = (np.array(sorted({row[key] for row in each})) for key in 'xy')
        order = sorted(each, key=lambda row: (row.x, row.y))
        bends = np.array([row.value for row in order]).reshape(len(apart), len(steps))
        shown = axes.pcolormesh(1e3 * steps, apart, np.clip(bends, 1e-6, 3.0), cmap='viridis',
                                shading='nearest', norm=LogNorm(1e-6, 3.0), rasterized=True)
        broken = [row for row in each if not np.isfinite(row.theory)]
        axes.plot([1e3 * row.y for row in broken], [row.x for row in broken], 'rx')
        axes.set(xscale='log', yscale='log')
        axes.axvline(50.0, color='w', linestyle='--', linewidth=1.0)
        axes.axhline(1e6, color='w', linestyle='--', linewidth=1.0)
        style.label(axes, 'step [ms]', 'stiffest joint / softest', name + ', red: not finite')
    figure.colorbar(shown, ax=panels[-1]).set_label('[rad]')
    return figure


CHART = Chart('stability_storms', 'the default in a storm over step and spread of stiffness',
              'stability_bench', COLUMNS, draw, sized('--part', 'storms'))
