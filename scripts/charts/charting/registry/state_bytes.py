# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rate of the messages of state: error of what replicas show against bytes a second."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'part': str, 'topic': str, 'reader': str, 'rate': float, 'bytes': float, 'rms': float,
           'high': float, 'largest': float, 'chosen': float}
NAMES = {'trees': 'tips of physical branches', 'people': 'ends of limbs'}
TITLES = {'trees': 'trees in a breeze, pulled and pushed', 'people': '300 people who wander'}


def draw_part(axes, rows):
    """Draws the error against the bytes a second, a curve for each reader of a topic."""
    for number, ((topic, reader), own) in enumerate(groups(rows, 'topic', 'reader').items()):
        rates = [1e-3 * row.bytes for row in own]
        # Curves may coincide: each has smaller points than the one before.
        axes.loglog(rates, [1e3 * row.high for row in own], '-', marker=style.MARKERS[number],
                    color=style.COLOURS[number], markersize=8 - 2 * number,
                    linewidth=2.8 - 0.9 * number, label='%s, %s' % (topic, reader))
        axes.plot(rates, [1e3 * row.largest for row in own], ':', color=style.COLOURS[number],
                  linewidth=1.0)
        for row, x in zip(own, rates):
            if row.chosen:
                style.ring(axes, x, 1e3 * row.high, 'default' if number == 0 else '')
            elif topic != 'forest/view':
                beside = {'offset': (-6, -10), 'ha': 'right'} if topic == 'agents/view' else {}
                style.note(axes, x, 1e3 * row.high, '%g' % row.rate, **beside)
    axes.margins(x=0.12)
    style.label(axes, 'messages [kB/s]', 'error of %s, 99 %% [mm]' % NAMES[rows[0].part],
                '%s (numbers: Hz; dotted: largest)' % TITLES[rows[0].part])
    axes.legend(loc='lower left')


def draw(rows):
    figure, (panels,) = style.figure(
        'Messages of state: what sensors and displays show at any time', 1, 2, size=(5.4, 4.4))
    for axes, own in zip(panels, groups(rows, 'part').values()):
        draw_part(axes, own)
    return figure


SOURCES = ('src/ros/conversions', 'src/ros/replicas', 'src/forest', 'src/tree', 'src/crowd',
           'scenes/forest', 'bench/state_bench.cpp')
ADVICE = ('Leave 30 Hz (default): half as many messages make errors two to four times as large. Leave '
          'displays on agents/view, an eighth of the bytes of agents for the same error.')
CHART = Chart('state_bytes', 'error and bytes of messages of state by their rate', ADVICE,
              'state_bench', COLUMNS, draw, SOURCES)
