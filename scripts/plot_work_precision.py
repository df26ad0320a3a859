#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws work-precision curves from the CSV files that bench/physics_bench writes.

usage: physics_bench --csv work_precision.csv
       scripts/plot_work_precision.py work_precision.png work_precision.csv [MORE.csv ...]
"""
import csv
import math
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

# engine: (colour, marker, label); ours in warm and dark, peers dashed.
STYLES = {
    'midpoint, plain double': ('#1b5e20', 'o', 'midpoint, plain (default)'),
    'midpoint, SIMD, one tree': ('#66a61e', 'o', 'midpoint, SIMD, one tree'),
    'midpoint, SIMD, 16 trees': ('#b2df8a', 'o', 'midpoint, SIMD, 16 trees, each'),
    'implicit Euler': ('#a6761d', 'v', 'implicit Euler'),
    'semi-implicit Euler': ('#e6ab02', '^', 'semi-implicit Euler'),
    'explicit Euler': ('#999999', '<', 'explicit Euler'),
    'Runge-Kutta 4': ('#444444', '>', 'Runge-Kutta 4'),
    'paper dynamics, midpoint': ('#d95f02', '*', "the paper's dynamics, midpoint"),
    'Bullet, float': ('#e7298a', 's', 'Bullet'),
    'DART': ('#7570b3', 'D', 'DART'),
    'MuJoCo, Euler': ('#1f78b4', 'P', 'MuJoCo, Euler'),
    'MuJoCo, RK4': ('#a6cee3', 'X', 'MuJoCo, RK4'),
}


def read(files):
    """{(branches, tree, load): {engine: [(ms, error), ...]}} of whole runs that were stable."""
    cells = {}
    for name in files:
        with open(name) as file:
            for row in csv.DictReader(file):
                error = float(row['error'])
                if row['note'] != 'run' or row['instants'] != '60' or not math.isfinite(error):
                    continue
                key = (int(row['branches']), row['tree'], row['load'])
                cells.setdefault(key, {}).setdefault(row['engine'], []).append(
                    (float(row['ms_per_simulated_second']), error))
    return cells


def draw(axes, key, engines):
    for engine, (colour, marker, label) in STYLES.items():
        if engine not in engines:
            continue
        ours = engine[0].islower() or engine.startswith('Runge')
        cost, error = zip(*sorted(engines[engine]))
        axes.loglog(cost, error, '-' if ours else '--', marker=marker, color=colour, markersize=4,
                    linewidth=2.2 if 'plain' in engine else 1.2, label=label)
    for target in (1e-2, 1e-3):
        axes.axhline(target, color='0.6', linewidth=0.8, linestyle=':')
    axes.set_ylim(1e-7, 2.0)
    axes.set_title('%s tree, %d branches, %s' % (key[1], key[0], key[2]))
    axes.set_xlabel('processor time for a simulated second [ms]')
    axes.set_ylabel('error of the tips, relative')
    axes.grid(True, which='major', linewidth=0.3)


def main(png_file, *csv_files):
    cells = read(csv_files)
    columns = 2
    rows = (len(cells) + columns - 1) // columns
    figure, grid = plt.subplots(rows, columns, figsize=(13.0, 4.2 * rows), squeeze=False)
    for axes, key in zip(grid.flat, sorted(cells)):
        draw(axes, key, cells[key])
    for axes in grid.flat[len(cells):]:
        axes.axis('off')
    handles = {}
    for axes in grid.flat:
        handles.update({label: line for line, label in zip(*axes.get_legend_handles_labels())})
    figure.legend(handles.values(), handles.keys(), loc='lower center', ncol=4, fontsize=9)
    figure.tight_layout(rect=(0.0, 0.9 / (4.2 * rows), 1.0, 1.0))
    figure.savefig(png_file, dpi=100)


if __name__ == '__main__':
    main(*sys.argv[1:])
