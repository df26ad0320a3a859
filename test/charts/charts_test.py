#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the program charts: its files, its errors and its rules for drawing."""
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

import rostest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / 'scripts/charts/charts'
sys.path.insert(0, str(PROGRAM.parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import direct_values  # noqa: E402
from charting import registry, stamp, style, tables  # noqa: E402
from charting.chart import RequestError  # noqa: E402

PER_UNIT = {None: 1.0, '%': 100.0, 'mm': 1e3, 'pixel': 1.0}  # of errors
LADDER = 'ladder,tier,setting,cost,error,chosen\n'


def run(*command, **environment):
    return subprocess.run([str(word) for word in command], text=True, capture_output=True,
                          env={**os.environ, **environment}, timeout=600)


def size_of(png):
    head = png.read_bytes()[:24]
    assert head[:8] == b'\x89PNG\r\n\x1a\n', png
    return struct.unpack('>II', head[16:24])


def accept_interrupts():
    """Restores the default handler, because processes that a shell starts in the background ignore
    the signal."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Charts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / 'out'

    def bench(self, name, script):
        """Returns an environment whose bench runs `script`; $FILE is the path of the table."""
        program = self.folder / 'space/lib/vegetation_sim' / name
        program.parent.mkdir(parents=True, exist_ok=True)
        program.write_text('#!/bin/sh\nwhile [ "$1" != --csv ]; do shift; done\nFILE=$2\n' + script)
        program.chmod(0o755)
        return {'CMAKE_PREFIX_PATH': str(self.folder / 'space')}

    def assert_drawn(self, name):
        chart = registry.all_charts()[name]
        self.assertGreaterEqual(len(tables.read(self.out / (name + '.csv'), chart.columns)), 5)
        width, height = size_of(self.out / (name + '.png'))
        self.assertGreater(width, 600)
        self.assertGreater(height, 250)
        self.assertIn('</svg>', (self.out / (name + '.svg')).read_text())

    # N9: the test runs the real program and the real benches.
    def test_quick_charts_are_measured_and_drawn(self):
        done = run('rosrun', 'vegetation_sim', 'charts', '--quick', '--only',
                   'grass_ladder,stability_limits', '--out', self.out)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.assertIn('[2/2] stability_limits', done.stdout)
        self.assertIn('2 of 2 charts', done.stdout)
        self.assert_drawn('grass_ladder')
        self.assert_drawn('stability_limits')
        direct_values.check_step_limits(self, tables.read(
            self.out / 'stability_limits.csv', registry.all_charts()['stability_limits'].columns))
        words = (self.out / 'grass_ladder.svg').read_text()
        for wanted in ('default', 'Pareto front', 'processor time of a blade [ns]'):
            self.assertIn(wanted, words)
        self.assertFalse(list(self.out.glob('*.part')))

    # N9: values in the documentation agree with direct computations.
    def test_documented_values_are_those_of_direct_computation(self):
        def rows_of(name):
            columns = registry.all_charts()[name].columns
            return tables.read(ROOT / 'docs/charts' / (name + '.csv'), columns)
        direct_values.check_step_limits(self, rows_of('stability_limits'))
        direct_values.check_breeze(self, rows_of('breeze_spectrum'))
        damaged = rows_of('stability_limits')
        damaged[0]['y'] *= 1.01
        with self.assertRaises(AssertionError):
            direct_values.check_step_limits(self, damaged)

    # N9: the points of a chart are the errors of its table, in the unit of their axis.
    def test_errors_are_drawn_in_the_unit_of_their_axis(self):
        checked = set()
        for path in sorted((ROOT / 'docs/charts').glob('*.csv')):
            chart = registry.all_charts()[path.stem]
            rows = tables.read(path, chart.columns)
            numbers = {value for row in rows for value in row.values() if isinstance(value, float)}
            figure = chart.draw(rows)
            self.addCleanup(style.plt.close, figure)
            for axes in figure.axes:
                quantity = re.search(r'(error|distance|displacement)[^[]*(\[(%|\w+))?',
                                     axes.get_ylabel())
                if quantity:
                    checked.add(path.stem)
                    self.check_points(axes, numbers, PER_UNIT[quantity.group(3)], path.stem)
        self.assertGreaterEqual(len(checked), 9, checked)

    def check_points(self, axes, numbers, factor, name):
        """Checks that all points are `factor` times a number of the table, but for those at the
        bottom, where some charts draw smaller errors. Lines without markers are guides."""
        drawn = [y for line in axes.lines if line.get_marker() != 'None' for y in line.get_ydata()]
        wanted = {'%.9g' % (factor * number) for number in numbers}
        self.assertGreater(len(drawn), 3, name)
        others = [y for y in drawn if y > min(drawn) and '%.9g' % y not in wanted]
        self.assertEqual(others, [], '%s: %s' % (name, axes.get_ylabel()))

    def test_errors_name_unknown_charts(self):
        done = run(PROGRAM, '--only', 'grass_ladder,no_such', '--out', self.out)
        self.assertEqual(done.returncode, 2)
        self.assertIn('no_such: no such chart', done.stderr)
        self.assertIn('work_precision', done.stderr)
        self.assertFalse(self.out.exists())
        self.assertEqual(run(PROGRAM, '--only', ',').returncode, 2)

    def test_errors_name_missing_benches(self):
        empty = str(self.folder)
        done = run(PROGRAM, '--only', 'grass_ladder', '--out', self.out, CMAKE_PREFIX_PATH=empty)
        self.assertEqual(done.returncode, 2)
        self.assertIn('grass_tile_bench: no such program', done.stderr)
        self.assertIn(empty, done.stderr)
        self.assertFalse(self.out.exists())

    def test_errors_name_invalid_folders(self):
        self.out.write_text('a file')
        space = self.bench('grass_tile_bench', 'exit 0')
        for bad in (self.out, self.out / 'below'):
            done = run(PROGRAM, '--only', 'grass_ladder', '--out', bad, **space)
            self.assertEqual(done.returncode, 2)
            self.assertIn('--out %s: ' % bad, done.stderr)

    # The program reports the bench that fails and draws the other charts.
    def test_benches_that_fail_do_not_stop_the_others(self):
        self.bench('grass_tile_bench', 'echo out of grass; exit 3')
        space = self.bench('influence_bench', 'printf "%s" > $FILE' % (LADDER.replace('\n', '\\n')))
        for depth in '12':
            for tier in range(4):
                self.bench_line('influence_bench', 'influence %s' % depth, tier)
            self.bench_line('influence_bench', 'depth %s' % depth, 4)
            self.bench_line('influence_bench', 'all %s' % depth, 5)
        done = run(PROGRAM, '--only', 'grass_ladder,influence_ladder', '--out', self.out, **space)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('grass_tile_bench', done.stderr)
        self.assertIn('code 3: out of grass', done.stderr)
        self.assertIn('1 of 2 charts', done.stdout)
        self.assert_drawn('influence_ladder')
        self.assertFalse((self.out / 'grass_ladder.png').exists())

    # Each bench waits for the other one, so neither would end if they ran one after the other.
    def test_quick_benches_run_two_at_a_time(self):
        for name, other in (('grass_tile_bench', 'influence_bench'),
                            ('influence_bench', 'grass_tile_bench')):
            space = self.bench(name, 'touch %s/%s.begun\nfor i in $(seq 100); do [ -e %s/%s.begun ] '
                               '&& exit 7; sleep 0.1; done\nexit 8' %
                               (self.folder, name, self.folder, other))
        done = run(PROGRAM, '--quick', '--only', 'grass_ladder,influence_ladder', '--out', self.out,
                   **space)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count('ended with code 7'), 2, done.stderr)

    # After an interrupt no bench still runs, and no file of a chart exists that had not begun.
    def test_an_interrupt_ends_the_benches(self):
        pid_file = self.folder / 'pids'
        os.mkfifo(pid_file)
        for name in ('grass_tile_bench', 'influence_bench', 'governor_bench'):
            space = self.bench(name, 'echo $$ > %s\nexec sleep 100' % pid_file)
        process = subprocess.Popen(
            [str(PROGRAM), '--quick', '--only', 'grass_ladder,influence_ladder,governor', '--out',
             str(self.out)], env={**os.environ, **space}, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, preexec_fn=accept_interrupts)
        with open(os.open(pid_file, os.O_RDWR)) as pids:  # Only two benches run at a time.
            running = [int(pids.readline()) for _ in range(2)]
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        for pid in running:
            with self.assertRaises(ProcessLookupError):
                os.kill(pid, 0)
        self.assertFalse((self.out / 'governor.log').exists())

    def bench_line(self, name, ladder, tier):
        with open(self.folder / 'space/lib/vegetation_sim' / name, 'a') as script:
            script.write('\necho "%s,%d,0.1,%g,%g,%d" >> $FILE' % (ladder, tier, 1e-5 * (tier + 1),
                                                                   0.5 ** tier, tier == 2))

    # Converged references are kept between runs: the bench gets their folder as an argument.
    def test_references_are_kept_beside_the_charts(self):
        space = self.folder / 'space/lib/vegetation_sim'
        space.mkdir(parents=True)
        bench = space / 'physics_bench'
        bench.write_text('#!/bin/sh\necho "$@"\nwhile [ "$1" != --cache ]; do shift; done\n'
                         'mkdir -p $2; touch $2/hash\nexit 1\n')
        bench.chmod(0o755)
        done = run(PROGRAM, '--quick', '--only', 'work_precision', '--out', self.out,
                   CMAKE_PREFIX_PATH=str(self.folder / 'space'))
        self.assertEqual(done.returncode, 1)
        self.assertTrue((self.out / 'references/hash').exists())
        self.assertIn('--quick', (self.out / 'work_precision.log').read_text())

    def test_tables_of_another_form_are_refused(self):
        space = self.bench('grass_tile_bench', 'echo a,b > $FILE; echo 1,2 >> $FILE')
        done = run(PROGRAM, '--only', 'grass_ladder', '--out', self.out, **space)
        self.assertEqual(done.returncode, 1)
        self.assertIn('its columns are "a,b", expected are "' + LADDER.strip(), done.stderr)
        path = self.folder / 'table'
        columns = registry.all_charts()['grass_ladder'].columns
        for text, wanted in ((LADDER, 'has no row'), (LADDER + 'a,1,x,y,1,1\n', 'line 2'),
                             (LADDER + 'a,1\n', '2 values for 6 columns')):
            path.write_text(text)
            with self.assertRaisesRegex(RequestError, wanted):
                tables.read(path, columns)

    # The tables in the documentation are sufficient to draw its figures again.
    def test_documented_tables_draw(self):
        self.out.mkdir()
        names = []
        for table in (ROOT / 'docs/charts').glob('*.csv'):
            (self.out / table.name).write_text(table.read_text())
            names.append(table.stem)
        self.assertIn('work_precision', names)
        done = run(PROGRAM, '--redraw', '--only', ','.join(names), '--out', self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in names:
            self.assert_drawn(name)

    # A documented chart is of the sources as they are now, and says of which commit and machine.
    def test_documented_charts_are_of_the_present_sources(self):
        folder = ROOT / 'docs/charts'
        stamps = stamp.read_all(folder)
        for name in sorted(registry.all_charts()):
            with self.subTest(name):
                self.assertIn(name, stamps, 'the chart has no stamp; measure it with --only')
                sources = registry.all_charts()[name].sources
                self.assertEqual(stamps[name]['sources'], stamp.hash_of(sources, ROOT),
                                 '%s have changed since the chart was measured: run charts --only '
                                 '%s --out docs/charts' % (', '.join(sources), name))
                self.assertRegex(stamps[name]['commit'], '^[0-9a-f]{7,40}$')
                self.assertIn('cores', stamps[name]['machine'])

    def test_charts_tell_their_commit_and_machine(self):
        space = self.bench('influence_bench', 'printf "%s" > $FILE' % (LADDER.replace('\n', '\\n')))
        for depth in '12':
            for tier in range(4):
                self.bench_line('influence_bench', 'influence %s' % depth, tier)
            self.bench_line('influence_bench', 'depth %s' % depth, 4)
            self.bench_line('influence_bench', 'all %s' % depth, 5)
        done = run(PROGRAM, '--only', 'influence_ladder', '--out', self.out, **space)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = stamp.read_all(self.out)['influence_ladder']
        self.assertEqual(written['extent'], 'usual')
        self.assertEqual(written['sources'], stamp.hash_of(
            registry.all_charts()['influence_ladder'].sources, ROOT))
        self.assertIn(stamp.text_of(written), (self.out / 'influence_ladder.svg').read_text())

    def test_comments_and_spaces_do_not_age_a_chart_but_code_does(self):
        folder, file = self.folder / 'src/grass', self.folder / 'src/grass/blade.cpp'
        header = self.folder / 'include/vegetation_sim/grass/blade.h'
        folder.mkdir(parents=True)
        header.parent.mkdir(parents=True)
        header.write_text('int blades();')
        hashes = []
        for text in ('int a = 1;', '// one\nint  a\n= /* not 2 */ 1;', 'int a = 2;',
                     'auto a = "package://x";', 'auto a = "package://y";'):
            file.write_text(text)
            hashes.append(stamp.hash_of(['src/grass'], self.folder))
        self.assertEqual(hashes[0], hashes[1])
        self.assertEqual(len(set(hashes)), 4)
        header.write_text('long blades();')
        self.assertNotEqual(stamp.hash_of(['src/grass'], self.folder), hashes[-1])

    def test_front_has_the_points_that_no_other_point_beats(self):
        points = [(1, 9), (2, 9), (2, 5), (3, 6), (4, 1), (5, float('nan')), (6, 1)]
        self.assertEqual(style.front(points), [(1, 9), (2, 5), (4, 1)])

    def test_slope_is_the_exponent_of_the_large(self):
        import numpy as np
        from charting.registry.cost_of_size import slope
        sizes = np.array([4.0 ** k for k in range(8)])
        self.assertAlmostEqual(slope(sizes, 1e-9 * sizes + 1e-8), 1.0, delta=0.05)
        self.assertAlmostEqual(slope(sizes, 1e-9 * sizes ** 2), 2.0, delta=1e-6)

    def test_every_chart_has_a_name_words_and_all_extents(self):
        charts = registry.all_charts()
        self.assertGreaterEqual(len(charts), 9)
        for chart in charts.values():
            self.assertTrue(chart.about and chart.advice and chart.columns, chart.name)
            self.assertEqual(set(chart.runs), {'quick', 'usual', 'full'})
            self.assertTrue((ROOT / 'bench' / (chart.bench + '.cpp')).exists(), chart.bench)
            self.assertIn('bench/%s.cpp' % chart.bench, chart.sources)
            for source in chart.sources:
                self.assertTrue(stamp.files_of([source], ROOT), source)


if __name__ == '__main__':
    rostest.rosrun('vegetation_sim', 'charts', Charts)
