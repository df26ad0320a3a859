# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""charts [--quick | --full] [--only NAME,..] [--out DIR] [--redraw]

Measures every method of the package that has a chart, and draws it. Writes DIR/NAME.csv, .png and
.svg, the output of the bench in NAME.log, converged references in DIR/references, and the commit
and the machine of each chart in DIR/charts.json.
"""
import argparse
from concurrent import futures
import os
import pathlib
import sys
import threading
import time

from charting import benches, registry, stamp, style, tables
from charting.chart import RequestError

STAMPING = threading.Lock()  # all charts have their stamps in one file
AT_ONCE = {'quick': 2, 'usual': 1, 'full': 1}  # benches; they measure processor time


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
    names = list(dict.fromkeys(name for name in only.split(',') if name))
    unknown = [name for name in names if name not in charts]
    if unknown or not names:
        raise RequestError('--only %s: no such chart; there are %s'
                      % (','.join(unknown) or "''", ', '.join(charts)))
    return [charts[name] for name in names]


def make_folder(path):
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RequestError('--out %s: cannot be made: %s' % (path, error.strerror))
    if not os.access(path, os.W_OK):
        raise RequestError('--out %s: cannot be written' % path)


def measure(chart, program, extent, out, progress):
    """Runs the bench of a chart for each of its runs and joins the tables; returns the seconds."""
    progress.begin()
    parts = []
    with open(out / (chart.name + '.log'), 'w') as log:
        for number, arguments in enumerate(chart.runs[extent]):
            parts.append(out / ('%s.%d.part' % (chart.name, number)))
            more = ['--cache', str(out / 'references')] if chart.cached else []
            log.write('%s %s\n' % (program.name, ' '.join(arguments)))
            benches.run(program, [*arguments, *more, '--csv', str(parts[-1])], log, progress)
    tables.join(parts, out / (chart.name + '.csv'), chart.columns)
    with STAMPING:
        stamp.write(out, chart, extent)
    return progress.seconds()


def wait_for(measured, progress):
    """Shows the progress of a measurement, if there is one, and returns the seconds it took."""
    progress.show()
    try:
        # A wait without timeout would delay an interrupt until its end.
        while measured and not measured.done():
            futures.wait([measured], timeout=0.2)
        return measured.result() if measured else 0.0
    finally:
        progress.done()


def begin(pool, chart, program, extent, out):
    """Starts the measurement of a chart, if there is a program; returns it and its progress."""
    progress = benches.Progress()
    measured = pool.submit(measure, chart, program, extent, out, progress) if program else None
    return chart, measured, progress


def draw_all(begun, out):
    """Draws charts as their measurements end; returns the number of failures."""
    failed = 0
    for number, (chart, measured, progress) in enumerate(begun, 1):
        print('[%d/%d] %s: %s' % (number, len(begun), chart.name, chart.about), flush=True)
        try:
            seconds = wait_for(measured, progress)
            rows = tables.read(out / (chart.name + '.csv'), chart.columns)
            line = stamp.text_of(stamp.read_all(out).get(chart.name))
            style.save(chart.draw(rows), out / chart.name, chart.advice, line)
            print('  %s.png and .svg, %.0f s' % (out / chart.name, seconds), flush=True)
        except RequestError as error:
            failed += 1
            print('\ncharts: %s' % error, file=sys.stderr, flush=True)
    return failed


def run(arguments):
    charts = registry.all_charts()
    options = parser(charts).parse_args(arguments)
    wanted = chosen(charts, options.only)
    # Every fault that can be found now is reported before anything is measured.
    programs = {chart.name: None if options.redraw else benches.find(chart.bench)
                for chart in wanted}
    out = pathlib.Path(options.out)
    make_folder(out)
    start = time.monotonic()
    with futures.ThreadPoolExecutor(AT_ONCE[options.extent]) as pool:
        try:
            begun = [begin(pool, chart, programs[chart.name], options.extent, out)
                     for chart in wanted]
            failed = draw_all(begun, out)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)  # before stop(), or the next bench would begin
            benches.stop()
            raise
    print('%d of %d charts in %.0f s' % (len(wanted) - failed, len(wanted),
                                         time.monotonic() - start))
    return 1 if failed else 0


def main(arguments):
    try:
        return run(arguments)
    except RequestError as error:
        print('charts: %s' % error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
