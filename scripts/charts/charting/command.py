# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""charts [--quick | --full] [--only NAME,..] [--out DIR] [--redraw]

Measures every method of the package that has a chart, and draws it: DIR/NAME.csv, .png and .svg,
what the bench said in NAME.log, converged references in DIR/references.
"""
import argparse
import os
import pathlib
import sys
import time

from charting import benches, registry, style, tables
from charting.chart import Refused


def parser(charts):
    names = '\n'.join('  %-18s %s' % (chart.name, chart.about) for chart in charts.values())
    out = argparse.ArgumentParser(
        prog='charts', formatter_class=argparse.RawDescriptionHelpFormatter,
        description='Measures the methods of the package and draws speed against accuracy.',
        epilog='charts:\n' + names)
    extent = out.add_mutually_exclusive_group()
    extent.add_argument('--quick', dest='extent', action='store_const', const='quick',
                        help='small scenes and few points: within 2 minutes')
    extent.add_argument('--full', dest='extent', action='store_const', const='full',
                        help='up to the largest sizes: hours')
    out.add_argument('--out', metavar='DIR', default='charts', help='where files go; ./charts')
    out.add_argument('--only', metavar='NAME,..', help='these charts')
    out.add_argument('--redraw', action='store_true', help='draws the tables that are in DIR')
    out.set_defaults(extent='usual')
    return out


def chosen(charts, only):
    if only is None:
        return list(charts.values())
    names = [name for name in only.split(',') if name]
    unknown = [name for name in names if name not in charts]
    if unknown or not names:
        raise Refused('--only %s: no such chart; there are %s'
                      % (','.join(unknown) or "''", ', '.join(charts)))
    return [charts[name] for name in names]


def make_folder(path):
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Refused('--out %s: cannot be made: %s' % (path, error.strerror))
    if not os.access(path, os.W_OK):
        raise Refused('--out %s: cannot be written' % path)


def measure(chart, program, extent, out, progress):
    """Runs the bench of a chart as often as the chart wants; its tables become one."""
    parts = []
    with open(out / (chart.name + '.log'), 'w') as log:
        for number, arguments in enumerate(chart.runs[extent]):
            parts.append(out / ('%s.%d.part' % (chart.name, number)))
            more = ['--cache', str(out / 'references')] if chart.cached else []
            log.write('%s %s\n' % (program.name, ' '.join(arguments)))
            benches.run(program, [*arguments, *more, '--csv', str(parts[-1])], log, progress)
    tables.join(parts, out / (chart.name + '.csv'), chart.columns)


def make(chart, program, extent, out):
    """Measures, unless there is no program to, and draws; the seconds it took."""
    progress = benches.Progress()
    if program:
        measure(chart, program, extent, out, progress)
    progress.done()
    rows = tables.read(out / (chart.name + '.csv'), chart.columns)
    style.save(chart.draw(rows), out / chart.name)
    return progress.seconds()


def run(arguments):
    charts = registry.all_charts()
    options = parser(charts).parse_args(arguments)
    wanted = chosen(charts, options.only)
    # All that can be refused is refused before anything is measured.
    programs = {chart.name: None if options.redraw else benches.find(chart.bench)
                for chart in wanted}
    out = pathlib.Path(options.out)
    make_folder(out)
    start, failed = time.monotonic(), 0
    for number, chart in enumerate(wanted, 1):
        print('[%d/%d] %s: %s' % (number, len(wanted), chart.name, chart.about), flush=True)
        try:
            seconds = make(chart, programs[chart.name], options.extent, out)
            print('  %s.png and .svg, %.0f s' % (out / chart.name, seconds), flush=True)
        except Refused as error:
            failed += 1
            print('\ncharts: %s' % error, file=sys.stderr, flush=True)
    print('%d of %d charts in %.0f s' % (len(wanted) - failed, len(wanted),
                                         time.monotonic() - start))
    return 1 if failed else 0


def main(arguments):
    try:
        return run(arguments)
    except Refused as error:
        print('charts: %s' % error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
