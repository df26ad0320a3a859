# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rate of the steps of physical trees: error against cost, free, held and pushed."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'load': str, 'species': str, 'rate': float, 'cost_ms': float, 'error': float,
           'error_mm': float, 'largest_mm': float, 'motion_mm': float, 'chosen': float}
NAMES = {'pushed': 'a limb is pushed by 20 N for 1 s',
         'held': 'a limb is pulled by 30 cm and released', 'storm': 'free in a storm of 18 m/s',
         'free': 'free in a breeze of 4.5 m/s'}


def middle(values):
    return sorted(values)[len(values) // 2]


def draw(rows):
    figure, ((axes,),) = style.figure('Steps a second of physical trees', size=(7.6, 4.8))
    rates = groups(rows, 'rate')
    costs = [middle([row.cost_ms for row in own]) for own in rates.values()]
    of = groups(rows, 'load', 'rate')
    for number, load in enumerate(NAMES):
        errors = [[100.0 * row.error for row in of[load, rate]] for rate in rates]
        worst = [max(each) for each in errors]
        axes.loglog(costs, worst, '-', marker=style.MARKERS[number], color=style.COLOURS[number],
                    label=NAMES[load])
        axes.fill_between(costs, [min(each) for each in errors], worst, alpha=0.15, linewidth=0,
                          color=style.COLOURS[number])
        for cost, error, rate in zip(costs, worst, rates):
            if of[load, rate][0].chosen:
                style.ring(axes, cost, error, 'default' if load == 'held' else '')
    axes.axhline(1.0, color='0.5', linewidth=0.8, linestyle=':', label='1 %')
    low, high = axes.get_ylim()
    axes.set_ylim(low, 4.0 * high)
    for rate, cost in zip(rates, costs):
        axes.axvline(cost, color='0.85', linewidth=0.8, zorder=0)
        axes.annotate('%d' % rate, (cost, 2.0 * high), ha='center', fontsize=8)
    style.label(axes, 'processor time of a second and 1 000 branches [ms]',
                'error of all tips, rms [% of their motion]',
                'numbers: steps a second; lines: worst of %d species, bands: all' %
                len(groups(rows, 'species')))
    axes.legend(loc='lower left')
    return figure


SOURCES = ('src/tree/physical', 'src/forest/physics', 'src/dynamics', 'scenes/forest',
           'bench/step_rate_bench.cpp')
ADVICE = ('Leave the rate to the forest: trees that are pulled, pushed or touched, and 2 s later, take '
          '240 steps a second; those that move freely in wind 60, in less than half the time.')
CHART = Chart('step_rate', 'error and cost of the rate of the steps of physical trees', ADVICE,
              'step_rate_bench', COLUMNS, draw, SOURCES)
