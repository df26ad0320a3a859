# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A body driven through crowns: depth by speed, and rises of the force by cost."""
from charting import style
from charting.chart import Chart, sized
from charting.tables import groups

COLUMNS = {'rule': str, 'species': str, 'speed': float, 'thin_mm': float, 'other_mm': float,
           'force': float, 'rise': float, 'cost_ms': float, 'chosen': float}
BAR = 5.0  # depth that thin wood must not exceed [mm]
RULES = {'whole steps': 'whole steps of 1/240 s', 'by force': 'halves, by change of the force',
         'by travel': 'parts, by travel', 'by travel and force': 'parts and halves (default)'}


def middle(values):
    return sorted(values)[len(values) // 2]


def worst_of(rows, rule, column):
    """Returns speeds and the largest value of all species at each."""
    own = groups([row for row in rows if row.rule == rule], 'speed')
    return list(own), [max(row[column] for row in each) for each in own.values()]


def draw(rows):
    figure, ((depth, rise),) = style.figure(
        'A capsule of 5 cm driven through crowns: ways to divide steps near it', 1, 2,
        size=(5.4, 4.4))
    of = groups(rows, 'rule')
    for number, (rule, name) in enumerate(RULES.items()):
        speeds, thin = worst_of(rows, rule, 'thin_mm')
        depth.loglog(speeds, thin, '-', marker=style.MARKERS[number],
                     color=style.COLOURS[number], label=name)
        at = (middle([row.cost_ms for row in of[rule]]), max(row.rise for row in of[rule]))
        rise.plot(*at, style.MARKERS[number], color=style.COLOURS[number], markersize=9)
        if of[rule][0].chosen:
            style.ring(rise, *at)
    speeds, other = worst_of(rows, 'by travel and force', 'other_mm')
    depth.loglog(speeds, other, '--s', color=style.BLACK, label='other wood, default')
    depth.axhline(BAR, color='0.5', linewidth=0.8, linestyle=':', label='bar for thin wood')
    rise.margins(0.25)
    rise.set_ylim(bottom=0.0)
    style.label(depth, 'speed of the capsule [m/s]', 'deepest overlap [mm]',
                'thin wood, up to 1 cm of radius, and other wood')
    style.label(rise, 'processor time of a second in one tree [ms]',
                'largest rise in a substep [N]', 'force on a branch')
    depth.set_xticks(speeds)
    depth.set_xticklabels(['%g' % speed for speed in speeds])
    depth.minorticks_off()
    style.legend_below(figure, (depth, rise), 3)
    return figure


SOURCES = ('src/dynamics', 'src/forest/contact', 'scenes/forest', 'bench/contact_bench.cpp')
ADVICE = ('Choose parts and halves (default), for more time than whole steps: parts keep fast '
          'bodies farthest below the bar of 5 mm, halves keep forces from jumping; drive at thin '
          'wood only, since a body overruns other wood by centimetres at any speed.')
CHART = Chart('contact', 'depth and cost of contacts by speed and substeps', ADVICE,
              'contact_bench', COLUMNS, draw, SOURCES, sized('--part', 'substeps'))
