# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The checks of the chaos test and their bars."""
from outcomes import LIMIT
from scene import NODES, SIMULATIONS
from table import Table

MOST_GAP = 0.5              # [s] of simulated time
MOST_SLOPE = 1.0            # [MB/h] of simulated time
ERRORS = 2.0                # standard errors by which a slope must exceed its bar
HASHES = 0.5                # least number of states compared in a second
SHORTEST_MEASUREMENT = 900  # [s]; the slope of a shorter time is that of noise


def check_all(rig, outcomes, seconds, final, again, replays):
    table = Table()
    add_conditions(table, rig, seconds)
    add_memory(table, rig, outcomes.rests)
    add_gaps(table, rig)
    add_names(table, rig, outcomes)
    table.add('winds after kills of wind_broadcaster', '%d equal, %d different' % (
        outcomes.winds_kept, outcomes.winds_changed), '0 different', outcomes.winds_changed == 0)
    add_hashes(table, rig, seconds, final, again, replays)
    return table


def add_conditions(table, rig, seconds):
    table.add('simulated time', '%g s' % seconds)
    table.add('clock waited for nodes', '%.1f s' % rig.clock.waited)
    visitors = rig.visitors
    table.add('good requests', '%d, refused %d, unanswered %d' % (
        visitors.sent, visitors.refused, visitors.unanswered))


def add_memory(table, rig, rests):
    if not rests:
        table.add('memory', 'not measured: the run is too short for each fault after the last kill')
        return
    for kind in rig.memory.KINDS:
        for node in NODES:
            trend = rig.memory.trend(node, kind, rests)
            duration = 3600.0 * trend.duration
            judged = duration >= SHORTEST_MEASUREMENT
            size, margin = rig.memory.samples[node, kind][-1][2], ERRORS * trend.error
            decided = abs(trend.slope - 1e6 * MOST_SLOPE) >= margin
            table.add('memory of %s, %s' % (node, kind), '%+.2f +- %.2f MB/h in %.0f s, %.1f MB%s' % (
                trend.slope / 1e6, trend.error / 1e6, duration, size / 1e6,
                '' if decided else ', undecided'),
                      '< %g MB/h + %g errors' % (MOST_SLOPE, ERRORS) if judged else '',
                      not judged or trend.slope - margin < 1e6 * MOST_SLOPE)


def add_gaps(table, rig):
    for node in NODES:
        gap, begin = rig.ticks.largest_gap(node, rig.processes.is_disturbed)
        table.add('largest gap of ' + node, '%.3f s at %.1f s, in %d ticks' % (
            gap, begin, rig.ticks.count[node]),
                  '<= %g s' % MOST_GAP, gap <= MOST_GAP)
        # The clock stands while it waits, so that the stamps do not show how long a tick takes.
        wait, at = rig.clock.longest_waits[node]
        table.add('longest wait of the clock for ' + node, '%.2f s of wall time, at %.1f s' % (
            wait, at),
                  '<= %g s' % MOST_GAP, wait <= MOST_GAP)


def add_names(table, rig, outcomes):
    for fault, times in sorted(outcomes.times.items()):
        missing = outcomes.count_unnamed(fault)
        table.add('%s: %d to be named' % (fault, len(times)),
                  'slowest %.1f s, not in time %d' % (outcomes.slowest(fault), missing),
                  '<= %g s' % LIMIT, missing == 0)
    table.add('jitters of the clock: %d' % outcomes.injected['jitter of the clock'],
              '%d jumps back' % rig.diagnosis.jumps_back, '0', rig.diagnosis.jumps_back == 0)
    table.add('bad requests', '%d, refused %d, unanswered %d' % (
        outcomes.requests, outcomes.refused, outcomes.unanswered), '0 unanswered',
              outcomes.unanswered == 0)
    table.add('services that accept all bad requests', ', '.join(sorted(outcomes.credulous)) or 'none',
              'none', not outcomes.credulous)


def add_hashes(table, rig, seconds, final, again, replays):
    recording = rig.recording
    table.add('events lost by the recorder', str(recording.lost), '0', recording.lost == 0)
    for node in SIMULATIONS:
        record, hashes = recording.nodes[node], replays[node].hashes
        common = sorted(set(record.hashes) & set(hashes))
        different = [stamp for stamp in common if record.hashes[stamp] != hashes[stamp]]
        events = sum(len(one) for one in record.events.values())
        table.add('events of ' + node, '%d; at kills %d doubled, %d not received' % (
            events, record.doubled, record.missing))
        figure = '%d ticks, %d hashes, %d different' % (len(common), len(set(hashes.values())),
                                                        len(different))
        if different:
            figure += ', first at %.3f s' % (different[0] / 1e9)
        table.add('replay of ' + node, figure, 'equal final hash',
                  final[node] == again[node] and not different and
                  len(common) > HASHES * seconds)
