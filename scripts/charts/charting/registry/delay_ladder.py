# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Layers behind the first one, which follow its history or one look-up in the present."""
from charting import style
from charting.chart import Chart, sized
from charting.tables import groups

NAMES = {'history': 'from the history, 31 frames', 'lookup': "the paper's one look-up",
         'nothing': 'no delay at all'}


def draw(rows):
    figure, ((errors, costs),) = style.figure(
        'A layer of leaves some time behind the first one, in gusts', 1, 2, size=(4.6, 3.8))
    for number, (what, own) in enumerate(groups(rows, 'what').items()):
        own = sorted(own, key=lambda row: row.size)
        errors.loglog([row.size for row in own], [100.0 * row.value for row in own],
                      '-' + style.MARKERS[number], color=style.COLOURS[number], label=NAMES[what])
        last = own[-1]
        if what == 'history':
            style.ring(errors, last.size, 100.0 * last.value, left=True)
        typical = own[len(own) // 2]
        costs.plot([1e3 * last.ratio], [100.0 * typical.value], style.MARKERS[number],
                   color=style.COLOURS[number], markersize=9)
        style.note(costs, 1e3 * last.ratio, 100.0 * typical.value, NAMES[what], (10, -12))
        if what == 'history':
            style.ring(costs, 1e3 * last.ratio, 100.0 * typical.value)
    typical = sorted({row.size for row in rows})[len({row.size for row in rows}) // 2]
    costs.set_yscale('log')
    costs.margins(x=0.6, y=0.2)
    costs.set_xlim(left=-10.0)
    errors.legend()
    style.label(errors, 'delay [s]', 'error, rms [% of the motion]', 'error')
    style.label(costs, 'processor time of a layer of 64 x 64 and tick [µs]',
                'error, rms [% of the motion]', 'cost, at a delay of %.2f s' % typical)
    return figure


SOURCES = ('src/canopy/layers', 'src/canopy/flow', 'src/canopy/plane', 'bench/canopy_bench.cpp')
ADVICE = ('Choose the history of 31 frames (default): its error is below 0.1 % at every '
          'delay, and it costs far less than the look-up.')
CHART = Chart('delay_ladder', 'error and cost of delayed layers', ADVICE,
              'canopy_bench', {'what': str, 'size': float, 'value': float, 'ratio': float},
              draw, SOURCES,
              sized('--part', 'delays'))
