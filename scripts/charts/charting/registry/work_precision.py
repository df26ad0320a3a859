# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Work and precision of every integrator and dynamics of a tree, beside peers."""
import math

from charting import style
from charting.chart import Chart
from charting.tables import groups

# engine: colour, marker, line, label; peers are dashed.
STYLES = {
    'midpoint, plain double': (style.GREEN, 'o', '-', 'linearly implicit midpoint, double (default)'),
    'midpoint, SIMD, one tree': (style.BLUE, 'o', '-', 'the same in vectors, single precision'),
    'midpoint, products at start': (style.SKY, 'o', '-',
                                    'the same, velocity products at start'),
    'implicit Euler': (style.PINK, 'v', '-', 'implicit Euler'),
    'semi-implicit Euler': (style.ORANGE, '^', '-', 'semi-implicit Euler'),
    'explicit Euler': (style.RED, '<', '-', 'explicit Euler'),
    'Runge-Kutta 4': (style.BLACK, 'p', '-', 'Runge-Kutta 4'),
    'paper dynamics, midpoint': (style.GREY, '*', '-', "dynamics of paper 1, midpoint"),
    'Bullet, float': (style.RED, 's', '--', 'Bullet'),
    'DART': (style.PINK, 'D', '--', 'DART'),
    'MuJoCo, Euler': (style.BLUE, 'P', '--', 'MuJoCo, Euler'),
    'MuJoCo, RK4': (style.BLACK, 'X', '--', 'MuJoCo, RK4'),
    'MuJoCo, implicit': (style.GREEN, 'P', '--', 'MuJoCo, implicit'),
    'MuJoCo, our midpoint': (style.BLUE, '*', '--', 'MuJoCo, with this midpoint'),
    'DART, our midpoint': (style.PINK, '*', '--', 'DART, with this midpoint'),
    'Simbody, Euler': (style.GREY, 's', '--', 'Simbody, Euler'),
    'Simbody, RK4': (style.GREY, 'X', '--', 'Simbody, RK4'),
    'position-based': (style.ORANGE, 'D', '--', 'position-based'),
}
DEFAULT = 'midpoint, plain double'
STEPS = 240.0  # per second, of the default
COLUMNS = {'tree': str, 'branches': float, 'load': str, 'engine': str, 'kind': str, 'error': float,
           'steps_per_second': float, 'ms_per_simulated_second': float, 'instants': float,
           'note': str}
OWN = 'plain double,SIMD,implicit Euler,explicit Euler,Runge-Kutta 4,paper'  # parts of names


def curves(rows):
    """Returns {engine: [(ms, error, steps), ...]} of complete stable runs, by cost."""
    out = {}
    # Large trees are compared over less than 3 s.
    window = max((row.instants for row in rows if row.note == 'run'), default=0)
    for row in rows:
        if row.note == 'run' and row.instants == window and math.isfinite(row.error):
            out.setdefault(row.engine, []).append(
                (row.ms_per_simulated_second, row.error, row.steps_per_second))
    return {engine: sorted(points) for engine, points in out.items()}


def style_of(engine, number):
    """Returns the style of an engine; engines that are not listed get a remaining one."""
    return STYLES.get(engine) or (style.COLOURS[number % len(style.COLOURS)], style.MARKERS[-1],
                                  '-.', engine)


def bounds(axes, rows):
    """Draws engines of which no run within the time cap holds an accuracy at their least cost."""
    for row in rows:
        if row.note == 'at_least' and math.isfinite(row.ms_per_simulated_second):
            colour = style_of(row.engine, 0)[0]
            axes.plot([row.ms_per_simulated_second], [row.error], '>', markersize=7, color=colour,
                      markerfacecolor=colour if row.kind == 'peer' else 'none')
    axes.plot([], [], '>', markersize=7, markerfacecolor='none', color='0.3',
              label='costs more; filled: other engines')


def panel(axes, engines):
    for number, (engine, points) in enumerate(engines.items()):
        colour, marker, line, words = style_of(engine, number)
        axes.loglog([p[0] for p in points], [p[1] for p in points], line, marker=marker,
                    markersize=4, color=colour, label=words,
                    linewidth=2.4 if engine == DEFAULT else 1.2)
    style.draw_front(axes, [p[:2] for points in engines.values() for p in points])
    if DEFAULT in engines:
        near = min(engines[DEFAULT], key=lambda p: abs(math.log(p[2] / STEPS)))
        style.ring(axes, near[0], near[1], 'default, step of 1/%.0f s' % near[2])
    for target in (1e-1, 1e-2, 1e-3):
        axes.axhline(target, color='0.5', linewidth=0.8, linestyle=':',
                     label='errors of 10, 1 and 0.1 %')
    least = min(p[1] for points in engines.values() for p in points)
    axes.set_ylim(min(1e-4, 0.3 * least), 2.0)


def draw(rows):
    cells = groups(rows, 'tree', 'branches', 'load')
    columns = 2 if len(cells) > 1 else 1
    lines = math.ceil(len(cells) / columns)
    figure, panels = style.figure('Work and precision of every method and engine on the same tree', lines, columns, size=(5.6, 3.7 if lines > 1 else 4.8))
    for axes, key in zip(panels.flat, sorted(cells)):
        panel(axes, curves(cells[key]))
        bounds(axes, cells[key])
        style.label(axes, 'processor time for a simulated second [ms]',
                    'error of the tips, relative', '%s tree, %d branches, %s' % key)
    for axes in panels.flat[len(cells):]:
        axes.axis('off')
    style.legend_below(figure, panels.flat, 4)
    return figure


def runs(extent):
    """Returns the runs: peers on what they can do in time, the default on everything."""
    tree = ['--trees', 'fractal', '--rounds', '3']
    if extent == 'quick':
        return [['--quick', *tree, '--cap', '1']]
    if extent == 'usual':
        return [[*tree, '--branches', '100', '--cap', '2'],
                [*tree, '--branches', '1000', '--cap', '4'],
                [*tree, '--branches', '10000', '--loads', 'gust', '--window', '1', '--cap', '10',
                 '--engines', OWN]]
    return [['--trees', 'fractal,oak', '--branches', '100,1000', '--cap', '60'],
            ['--trees', 'fractal,oak', '--branches', '10000', '--window', '1', '--cap', '60']]


SOURCES = ('src/dynamics', 'bench/trees', 'bench/peers', 'bench/physics_bench.cpp')
ADVICE = ('Choose the linearly implicit midpoint (default), the cheapest at every '
          'accuracy; the nodes step it in vectors. Choose a shorter step for a tree that '
          'is pulled hard, and Runge-Kutta 4 for references only.')
CHART = Chart('work_precision', 'error and cost of every integrator, dynamics and peer', ADVICE,
              'physics_bench', COLUMNS, draw, SOURCES,
              {extent: runs(extent) for extent in ('quick', 'usual', 'full')}, cached=True)
