# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Error against processor time of the trees and the grass of whole scenarios, by tolerance."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

PARTS = {'trees': 'trees: error of 99 % of tips and instants [pixel]',
         'grass': 'grass: largest length that is omitted [pixel]'}


def draw(rows):
    figure, panels = style.figure('Whole scenes by tolerance', 1, 2, size=(5.6, 4.6))
    for axes, (part, text) in zip(panels[0], PARTS.items()):
        own = groups([row for row in rows if row.part == part], 'scenario')
        for number, (scenario, points) in enumerate(own.items()):
            points = sorted(points, key=lambda row: row.tolerance)
            axes.loglog([row.ms for row in points], [max(row.error, 1e-2) for row in points],
                        marker=style.MARKERS[number % len(style.MARKERS)],
                        color=style.COLOURS[number % len(style.COLOURS)],
                        linestyle='-' if number < len(style.COLOURS) else '--', label=scenario)
            for row in points:
                if row.chosen:
                    style.ring(axes, row.ms, max(row.error, 1e-2), '')
        axes.axhline(1.0, color='0.5', linewidth=0.8, linestyle=':')
        style.label(axes, 'processor time of a frame [ms]', text,
                    'rings: defaults; points: 1/4 to 16 times the default')
        axes.legend(fontsize=7, ncol=2)
    return figure


SOURCES = ('src/tree', 'src/forest', 'src/grass', 'bench/frame', 'scenes/forest/prediction_scene.h',
           'bench/scene_bench.cpp')
ADVICE = ('Keep the default tolerances: trees are then right within a pixel, but for reef and '
          'vineyard, where no tolerance helps. A quarter of them costs up to nine times as much.')
CHART = Chart('scene_error', 'error against processor time of whole scenarios', ADVICE,
              'scene_bench',
              {'scenario': str, 'part': str, 'tolerance': float, 'ms': float, 'error': float,
               'chosen': float}, draw, SOURCES)
