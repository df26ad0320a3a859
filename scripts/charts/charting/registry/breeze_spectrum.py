# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A breeze over ten minutes at a point, compared with the law in docs/wind.md."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

COLOURS = {'along': style.BLUE, 'across': style.GREEN, 'up': style.RED}


def draw(rows):
    figure, ((spectrum, statistics),) = style.figure(
        'A breeze of 5 m/s, turbulence 0.3, at one point: measured and stated', 1, 2)
    of = groups(rows, 'quantity')
    for name, colour in COLOURS.items():
        density = of['density_' + name]
        spectrum.loglog([row.seed_or_hz for row in density], [row.measured for row in density], 'o',
                        color=colour, markersize=4, label=name + ', measured')
        stated = [row for row in density if row.stated > 0.0]
        spectrum.loglog([row.seed_or_hz for row in stated], [row.stated for row in stated], '-',
                        color=colour, label=name + ', stated')
        for quantity, marker in (('mean', 's'), ('rms', '.')):
            each = of['%s_%s' % (quantity, name)]
            statistics.plot([row.seed_or_hz for row in each], [row.measured for row in each],
                            marker, color=colour, markersize=4, label='%s %s' % (quantity, name))
            statistics.axhline(each[0].stated, color=colour, linewidth=0.8)
    for edge in (0.01, 2.0):
        spectrum.axvline(edge, color='0.5', linewidth=0.8, linestyle='--')
    spectrum.set_ylim(1e-4, 1e2)
    seeds = len(of['mean_along'])
    style.label(spectrum, 'frequency [Hz]', 'spectral density [(m/s)²/Hz]',
                'mean of %d seeds; dashed: the band with turbulence' % seeds)
    style.label(statistics, 'seed', 'mean and rms over 10 minutes [m/s]', 'lines: stated')
    for axes in (spectrum, statistics):
        axes.legend(ncol=2)
    return figure


SOURCES = ('src/wind', 'bench/breeze_spectrum.cpp')
ADVICE = ('Trust the breeze from 0.01 to 2 Hz, where spectrum, mean and rms are as '
          'stated.')
CHART = Chart('breeze_spectrum', 'spectrum, mean and rms of a breeze', ADVICE, 'breeze_spectrum',
              {'quantity': str, 'seed_or_hz': float, 'measured': float, 'stated': float},
              draw, SOURCES)
