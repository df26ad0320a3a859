# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The style of all charts.

Colours differ for colour-blind readers too, the default has a ring, and the Pareto front is a broad
band underneath.
"""
import io
import math
import textwrap

import matplotlib
from PIL import Image
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter  # noqa: E402

# Okabe and Ito 2008.
BLACK, ORANGE, SKY, GREEN = '#000000', '#E69F00', '#56B4E9', '#009E73'
YELLOW, BLUE, RED, PINK, GREY = '#F0E442', '#0072B2', '#D55E00', '#CC79A7', '#999999'
WINE = '#882255'  # Tol
COLOURS = (BLUE, RED, GREEN, ORANGE, PINK, SKY, BLACK, GREY, WINE)
MARKERS = 'osD^vPX<>*'
FRONT = '#D9D9D9'
STRIP = 0.16  # height of the line below a chart [inch]
LINE = 0.19  # height of a line of advice [inch]
LETTERS = 12.5  # of the advice in an inch
DOTS_PER_INCH = 96
HALO = [withStroke(linewidth=1.5, foreground='white')]  # behind words that a curve may cross

plt.rcParams.update({
    'font.size': 9, 'axes.titlesize': 10, 'axes.grid': True, 'axes.axisbelow': True,
    'grid.linewidth': 0.3, 'legend.fontsize': 8, 'legend.framealpha': 0.9, 'lines.markersize': 5,
    'lines.linewidth': 1.4, 'svg.fonttype': 'none', 'svg.hashsalt': 'vegetation_sim',
    'axes.spines.top': False, 'axes.spines.right': False, 'figure.constrained_layout.use': True})


def figure(title, rows=1, columns=1, size=(5.6, 4.2), **options):
    """Returns a titled figure and its axes [rows][columns]."""
    out, axes = plt.subplots(rows, columns, figsize=(size[0] * columns, size[1] * rows),
                             squeeze=False, **options)
    out.suptitle(title, fontsize=11, fontweight='bold')
    return out, axes


def label(axes, x, y, title=None):
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title)
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        if axis.get_scale() == 'log' and high / low < 300.0:  # powers of ten alone are too few
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(FormatStrFormatter('%g'))
            axis.set_minor_formatter(NullFormatter())


def front(points):
    """Returns the points (cost, error) that no other beats in both, by cost."""
    out = []
    for cost, error in sorted(p for p in points if all(map(math.isfinite, p))):
        if not out or error < out[-1][1]:
            out.append((cost, error))
    return out


def draw_front(axes, points):
    """Draws the Pareto front as steps: the least error at each cost."""
    best = front(points)
    if len(best) < 2:
        return
    axes.step(*zip(*best), where='post', color=FRONT, linewidth=7, zorder=0,
              solid_capstyle='round', label='Pareto front')


def ring(axes, x, y, text='default', left=False):
    """Marks the default with a ring and a word on the right, or with `left` on the left."""
    axes.plot([x], [y], 'o', markersize=12, markerfacecolor='none', markeredgecolor=BLACK,
              markeredgewidth=1.6, zorder=5)
    axes.annotate(text, (x, y), textcoords='offset points',
                  xytext=(-9 if left else 9, 9), ha='right' if left else 'left',
                  fontweight='bold', zorder=6, path_effects=HALO)


BESIDE = (6, 4), (6, -10), (-6, 4), (-6, -10)  # where words may stand at a point [points]


TIGHTER = 1.3  # factor by which titles and legends later compress the axes


def box(x, y, half=4.0):
    return x - half, y - half, x + half, y + half


def box_of_words(x, y, text, offset, bold=False):
    """Returns the pixels that note() or ring() cover at (x, y): left, low, right, high."""
    pixel = plt.rcParams['figure.dpi'] / 72.0 * TIGHTER
    size = 9.0 if bold else 7.5
    width, left = 0.58 * size * len(text), offset[0]
    if left < 0:
        left -= width
    return (x + pixel * left, y + pixel * (offset[1] - 1.0), x + pixel * (left + width),
            y + pixel * (offset[1] + size - 1.0))


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def note(axes, x, y, text, offset=(6, 4), **options):
    axes.annotate(text, (x, y), textcoords='offset points', xytext=offset, fontsize=7.5,
                  **{'color': '0.25', **options})


def edges_of(centres):
    """Returns the edges of the cells around rising centres, as old versions of pcolormesh need."""
    middles = [0.5 * (a + b) for a, b in zip(centres, centres[1:])]
    return [2 * centres[0] - middles[0], *middles, 2 * centres[-1] - middles[-1]]


def leave_below(out, height):
    """Keeps a height [inch] below the axes free."""
    share = height / out.get_figheight()
    if hasattr(out, 'get_layout_engine'):
        out.get_layout_engine().set(rect=(0.0, share, 1.0, 1.0 - share))
    else:  # Matplotlib before 3.6
        out.set_constrained_layout(False)
        out.tight_layout(rect=(0.0, share, 1.0, 0.95))


def legend_below(out, axes, columns=4):
    """Draws one legend below all axes, with each name once."""
    handles = {}
    for each in axes:
        handles.update({name: line for line, name in zip(*each.get_legend_handles_labels())})
    out.legend(handles.values(), handles.keys(), loc='lower center', ncol=columns)


def write_advice(out, text):
    """Writes what to choose below the axes and the legend, for which the figure becomes higher."""
    lines = textwrap.wrap(text, int(LETTERS * out.get_figwidth()))
    out.set_figheight(out.get_figheight() + LINE * len(lines))
    height = STRIP + LINE * len(lines)
    out.text(0.5, (height - 0.02) / out.get_figheight(), '\n'.join(lines), ha='center', va='top',
             fontsize=9.5, fontweight='bold')
    for legend in out.legends:
        legend.set_bbox_to_anchor((0.5, height / out.get_figheight()), transform=out.transFigure)
        height += legend.get_window_extent(out.canvas.get_renderer()).height / out.dpi + 0.1
    leave_below(out, height)


def save(out, path, advice='', stamp=''):
    """Saves as PNG and SVG, without a date, so that equal figures give equal files.

    `stamp` is the last line, below the advice.
    """
    write_advice(out, advice)
    out.text(0.995, 0.04 / out.get_figheight(), stamp, ha='right', fontsize=6.5, color='0.35')
    picture = io.BytesIO()
    out.savefig(picture, format='png', dpi=DOTS_PER_INCH)
    few = Image.open(picture).convert('RGB').quantize(255, dither=0)
    few.save(path.with_suffix('.png'), optimize=True)
    out.savefig(path.with_suffix('.svg'), metadata={'Date': None})
    plt.close(out)
