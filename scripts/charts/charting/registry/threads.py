# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Work that nodes split among threads: how many times faster by their number."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

COLUMNS = {'work': str, 'threads': float, 'cores': float, 'ms': float, 'times_faster': float}
NAMES = {'trees': 'physical trees: a tick', 'crowd': 'walkers among trunks: a tick',
         'lidar': 'lidar: a sweep', 'camera': 'camera: an image'}


def draw(rows):
    figure, ((axes,),) = style.figure('Work on several threads: wall time', size=(6.4, 4.8))
    most = max(row.threads for row in rows)
    axes.plot([1, most], [1, most], '--', color=style.GREY, label='ideal: as many times as threads')
    for number, (work, own) in enumerate(groups(rows, 'work').items()):
        axes.plot([row.threads for row in own], [row.times_faster for row in own], '-',
                  marker=style.MARKERS[number], color=style.COLOURS[number], label=NAMES[work])
    style.ring(axes, 1, 1)
    axes.set_xticks(sorted({row.threads for row in rows}))
    axes.set_ylim(bottom=0.0)
    style.label(axes, 'threads', 'times as fast as one thread',
                'machine with %d cores' % rows[0].cores)
    axes.legend(loc='upper left')
    return figure


SOURCES = ('src/core/threads', 'src/tree/physical', 'src/forest/physics', 'src/crowd',
           'src/sensors', 'scenes/forest', 'scenes/sensors', 'bench/thread_bench.cpp')
ADVICE = ('Choose as many threads for physical trees, crowds and sensors as cores are free '
          '(default 1, since nodes share the cores): results have the same bits.')
CHART = Chart('threads', 'speed of work on several threads', ADVICE, 'thread_bench', COLUMNS, draw,
              SOURCES)
