# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tables that benches write and charts are drawn from."""
import csv

from charting.chart import RequestError


class Row(dict):
    """A line of a table, where row.error is row['error']."""
    __getattr__ = dict.__getitem__


def read(path, columns):
    """Returns the rows, with numbers converted. Fails if the columns differ or no row exists."""
    try:
        with open(path, newline='') as file:
            lines = list(csv.reader(file))
    except OSError as error:
        raise RequestError('%s: %s' % (path, error.strerror))
    if not lines or lines[0] != list(columns):
        raise RequestError('%s: its columns are "%s", expected are "%s"'
                      % (path, ','.join(lines[0]) if lines else '', ','.join(columns)))
    if len(lines) == 1:
        raise RequestError('%s: has no row' % path)
    return [parse(path, number, line, columns) for number, line in enumerate(lines[1:], 2)]


def parse(path, number, line, columns):
    try:
        if len(line) != len(columns):
            raise ValueError('%d values for %d columns' % (len(line), len(columns)))
        return Row((name, kind(value)) for (name, kind), value in zip(columns.items(), line))
    except ValueError as error:
        raise RequestError('%s, line %d: %s' % (path, number, error))


def join(parts, path, columns):
    """Joins several tables of the same columns into one, and deletes them."""
    lines = []
    for part in parts:
        read(part, columns)
        lines += part.read_text().splitlines()[1:]
        part.unlink()
    path.write_text('\n'.join([','.join(columns), *lines]) + '\n')


def groups(rows, *names):
    """Returns {value or values of the columns: rows}, in the order of their first rows."""
    out = {}
    for row in rows:
        key = tuple(row[name] for name in names)
        out.setdefault(key if len(names) > 1 else key[0], []).append(row)
    return out
