# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Segments of a blade of grass, and tiers of a tile."""
from charting import ladders, style
from charting.chart import Chart


def draw(rows):
    figure, ((blade, tile),) = style.figure(
        'Grass: what is left out, and what the rest costs to pose and mesh', 1, 2, size=(5.6, 4.6))
    ladders.draw(blade, [type(row)(row, cost=1e9 * row.cost, error=100.0 * row.error)
                         for row in rows if row.ladder != 'tile'],
                 names={'arc': 'arc of constant length (default)',
                        'paper': "the paper's curve"}.get,
                 setting=lambda row: '%g' % row.tier, left=True)
    style.label(blade, 'processor time of a blade [ns]',
                'largest distance from the arc [% of its length]',
                'segments of a blade bent by 1 rad, 5 near by and fewer far away')
    blade.legend(loc='lower left')
    tiles = [row for row in rows if row.ladder == 'tile']
    points = [(1e6 * row.cost, 1e3 * row.error) for row in tiles]
    tile.loglog(*zip(*points), 'o', color=style.BLUE)
    style.draw_front(tile, points)
    for number, (row, point) in enumerate(zip(tiles, points)):
        style.note(tile, *point, row.setting, (8, 4) if number < 2 else (-8, 6),
                   ha='left' if number < 2 else 'right')
    tile.set_ylim(bottom=0.5 * points[-1][1], top=2.5 * points[0][1])
    style.label(tile, 'processor time of a tile of 4 000 blades [µs]',
                "mean distance of a blade's tip from what is drawn for it [mm]",
                'what is drawn for a tile; nothing would be off by 24 cm')
    tile.legend(loc='lower left')
    return figure


SOURCES = ('src/grass/blades', 'src/grass/lod', 'bench/grass_tile_bench.cpp')
ADVICE = ('Choose the arc of constant length (default), with 5 segments near by and 2 '
          'far away, and leave blades and strips to the tolerance in pixels: strips cost '
          'a small part of all blades.')
CHART = Chart('grass_ladder', 'error and cost of grass: segments, strips, blades', ADVICE,
              'grass_tile_bench', ladders.COLUMNS, draw, SOURCES)
