# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Displacement of the branches that a lidar meets against processor time, by its tolerance."""
from charting import ladders, style
from charting.chart import Chart, sized



def draw(rows):
    figure, ((axes,),) = style.figure('A lidar in the scenario forest', size=(7.2, 4.6))
    in_units = [type(row)(row, cost=1e3 * row.cost, error=1e3 * row.error) for row in rows]
    ladders.draw(axes, in_units, names='range {} m'.format,
                 setting=lambda row: '%g mm' % (1e3 * float(row.setting)))
    style.label(axes, 'processor time of ticks and poses for a sweep at 10 Hz [ms]',
                'displacement of branches, 99 % of rays to wood below [mm]',
                'at the points: tolerance of the sensor')
    axes.legend()
    return figure


SOURCES = ('src/tree', 'src/forest', 'src/sensors/trees', 'scenes/sensors/range_error_scene.h',
           'bench/range_bench.cpp')
ADVICE = ('Keep the tolerance of 50 mm (default): branches are then sensed within about 11 mm. Choose '
          '10 mm for a few millimetres, at about half as much again.')
CHART = Chart('lidar_error', 'displacement of sensed branches against processor time', ADVICE,
              'range_bench', ladders.COLUMNS, draw, SOURCES, sized('--part', 'tolerance'))
