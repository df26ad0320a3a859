#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/charts/breeze_spectrum.png from the CSV that bench/breeze_spectrum prints.

usage: breeze_spectrum > docs/charts/breeze_spectrum.csv
       scripts/plot_breeze_spectrum.py docs/charts/breeze_spectrum.csv docs/charts/breeze_spectrum.png
"""
import csv
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {'along': '#1f77b4', 'across': '#2ca02c', 'up': '#d9822b'}


def main(csv_file, png_file):
    rows = {}
    with open(csv_file) as file:
        for row in csv.DictReader(file):
            rows.setdefault(row['quantity'], []).append(
                [float(row[key]) for key in ('seed_or_hz', 'measured', 'stated')])
    figure, (spectrum, statistics) = plt.subplots(
        1, 2, figsize=(12.0, 5.0), gridspec_kw={'width_ratios': [3, 2]})
    for name, colour in COLOURS.items():
        f, measured, stated = zip(*rows['density_' + name])
        spectrum.loglog(f, measured, 'o', color=colour, markersize=4, label=name + ', measured')
        inside = [(x, y) for x, y in zip(f, stated) if y > 0.0]
        spectrum.loglog(*zip(*inside), '-', color=colour, linewidth=1.5, label=name + ', stated')
        for quantity, marker in (('mean', 's'), ('rms', '.')):
            seeds, measured, stated = zip(*rows['%s_%s' % (quantity, name)])
            statistics.plot(seeds, measured, marker, color=colour, markersize=4,
                            label='%s %s' % (quantity, name))
            statistics.axhline(stated[0], color=colour, linewidth=0.8)
    for edge in (0.01, 2.0):
        spectrum.axvline(edge, color='0.6', linewidth=0.8, linestyle='--')
    spectrum.set_xlabel('frequency [Hz]')
    spectrum.set_ylabel('spectral density [(m/s)²/Hz]')
    spectrum.set_ylim(1e-4, 1e2)
    spectrum.set_title('Breeze of 5 m/s, turbulence 0.3: mean of 64 seeds, 10 minutes each')
    statistics.set_xlabel('seed')
    statistics.set_ylabel('over 10 minutes [m/s]')
    statistics.set_title('Lines: configured')
    for axes in (spectrum, statistics):
        axes.grid(True, which='major', linewidth=0.3)
        axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(png_file, dpi=110)


if __name__ == '__main__':
    main(*sys.argv[1:])
