# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Processor time of the parts of a frame in each scenario."""
from charting import style
from charting.chart import Chart
from charting.tables import groups

PARTS = {'levels': ('choice of levels', style.BLUE), 'physics': ('physics', style.RED),
         'state': ('state message', style.PINK), 'poses': ('poses of branches', style.GREEN),
         'meshes': ('meshes of trees', style.ORANGE), 'treading': ('treading', style.BLACK),
         'grass levels': ('levels of grass', style.SKY),
         'air on the grass': ('air on the grass', style.GREY),
         'blades and strips': ('blades and strips', style.YELLOW),
         'air in leaves': ('air in leafy masses', '#882255'),
         'layers of leaves': ('layers of leaves', '#44AA99'),
         'ways of people': ('ways of people', '#332288'),
         'bodies of people': ('bodies of people', '#DDCC77')}
LATER = ('#AA4499', '#999933')  # colours of further parts (Tol)


def draw(rows):
    scenarios = groups(rows, 'scenario')
    slowest_first = sorted(scenarios, reverse=True, key=lambda name: next(
        row.ms_99 for row in scenarios[name] if row.part == 'frame'))
    scenarios = {name: scenarios[name] for name in slowest_first}
    figure, ((axes,),) = style.figure('Processor time of a frame by part, one core',
                                      size=(8.0, 1.7 + 0.6 * len(scenarios)))
    parts = list(dict.fromkeys(row.part for row in rows if row.part != 'frame'))
    left = {name: 0.0 for name in scenarios}
    more = iter(LATER)
    longest = max(row.ms_99 for row in rows)
    for part in parts:
        words, colour = PARTS.get(part) or (part, next(more))
        for name, each in scenarios.items():
            ms = next((row.ms for row in each if row.part == part), 0.0)
            axes.barh(name, ms, left=left[name], color=colour, label=words, edgecolor='white',
                      linewidth=0.5)
            left[name] += ms
    for name, each in scenarios.items():
        total = next(row for row in each if row.part == 'frame')
        axes.plot([total.ms, total.ms_99], [name, name], '-', color=style.BLACK, marker='|')
        axes.annotate('%.2g ms, 99 %% below %.2g ms' % (total.ms, total.ms_99),
                      (total.ms_99, name), xytext=(6, 0), textcoords='offset points', va='center',
                      path_effects=style.HALO)
    for rate in (60, 30):
        axes.axvline(1e3 / rate, color=style.BLACK, linewidth=0.8, linestyle=':')
        axes.annotate('%d Hz' % rate, (1e3 / rate, -0.6), xytext=(3, 0), textcoords='offset points')
    axes.set_xlim(0.0, 1.35 * longest)
    axes.invert_yaxis()
    style.label(axes, 'median over frames [ms]; the line ends where 99 % of frames do',
                'scenario')
    style.legend_below(figure, [axes], 5)
    return figure


SOURCES = ('src/tree', 'src/forest', 'src/grass', 'src/crowd', 'src/canopy', 'bench/frame',
           'bench/frame_bench.cpp')
ADVICE = ('Lower the number of blades first where frames take too long: blades and '
          'strips are the largest part of most scenarios.')
CHART = Chart('frame_time', 'processor time of the parts of a frame in each scenario', ADVICE, 'frame_bench',
              {'scenario': str, 'part': str, 'ms': float, 'ms_99': float}, draw, SOURCES)
