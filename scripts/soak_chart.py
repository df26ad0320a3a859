#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a chart of the memory that soak_displays.sh logged, and prints the slopes.

usage: soak_chart.py FOLDER FILE.png, with a table DISPLAY.csv for each display in the folder.
Fails if memory grows, because the slope then shows a leak.
"""
import csv
import os
import sys
from pathlib import Path

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), 'charts'))
from charting import style  # noqa: E402

COUNTS = ('textures', 'materials', 'meshes', 'programs', 'buffers', 'nodes', 'objects',
          'texture bytes')
COLUMNS = ('what', 'time', 'resident', 'held') + COUNTS
STEADY = 0.25  # This share at the start of the run is left out, because caches fill.
LEAST = 6      # Minimum number of points: with fewer the error of a slope is meaningless.
MOST = 10.0    # A cycle may leave this much [kB]; the smallest image of the displays has 16 kB.


def read(path):
    """Reads the series of a display: a dictionary of columns for each kind of test."""
    rows = [dict(zip(COLUMNS, row)) for row in csv.reader(path.open())]
    return {what: {name: numpy.array([float(r[name]) for r in rows if r['what'] == what])
                   for name in COLUMNS[1:]} for what in {r['what'] for r in rows}}


def slope(series, name):
    """Returns the median slope of all pairs of points in the steady part, and its interval of three
    standard errors (Sen 1968) [kB per repetition], or None if there are too few points.

    The median ignores a message that is in transit at single points.
    """
    steady = series['time'] >= STEADY * series['time'][-1]
    count = numpy.count_nonzero(steady)
    if count < LEAST:
        return None
    time, value = series['time'][steady], series[name][steady]
    first, second = numpy.triu_indices(count, 1)
    slopes = 1000.0 * numpy.sort((value[second] - value[first]) / (time[second] - time[first]))
    spread = 3.0 * numpy.sqrt(count * (count - 1) * (2 * count + 5) / 18.0)
    low = max(int((len(slopes) - spread) / 2), 0)
    return numpy.median(slopes), slopes[low], slopes[-1 - low]


def draw(tables, path):
    out, axes = style.figure('Memory of rviz while displays come and go', 2, 2, size=(4.8, 3.0))
    for row, (what, unit) in enumerate((('cycles', 'displays made and destroyed'),
                                        ('reloads', 'times that the node died and returned'))):
        for column, (name, title) in enumerate((('resident', 'resident'), ('held', 'allocated'))):
            panel = axes[row][column]
            for colour, (display, table) in zip(style.COLOURS, sorted(tables.items())):
                if what in table:
                    panel.plot(table[what]['time'], table[what][name], color=colour, label=display)
            panel.set_ylim(bottom=0.0)
            style.label(panel, unit, 'MB', title)
    style.legend_below(out, [panel for row in axes for panel in row], columns=5)
    style.save(out, path)


def main(folder, picture):
    tables = {path.stem: read(path) for path in sorted(Path(folder).glob('*.csv'))}
    grew = False
    for display, table in tables.items():
        for what, series in sorted(table.items()):
            ogre = [f'{name} {series[name].min():g} to {series[name].max():g}' for name in COUNTS
                    if series[name][-1] > series[name][len(series[name]) // 4]]
            # The run ends one step after the last row.
            times = series['time'][-1] + (series['time'][-1] - series['time'][-2:-1]).sum()
            text = f'no slope: fewer than {LEAST} points after the first quarter'
            held, resident = slope(series, 'held'), slope(series, 'resident')
            if held is not None:
                grew |= held[1] > MOST
                text = (f'{held[0]:+.2f} ({held[1]:+.2f} to {held[2]:+.2f}) kB allocated, '
                        f'{resident[0]:+.2f} kB resident a time')
            print(f'{display}: {times:g} {what}, {text}' + ''.join(f'; {o}' for o in ogre))
    draw(tables, Path(picture))
    return 1 if grew else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:3]))
