#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what the shards of a world cost and what a listener receives; see scripts/shard_rates.sh.
Needs a master, and sets the clock.

usage: measure_shards.py FOLDER TILES WALKERS SHARDS TICKS [AREA PLACES RANGE]
       of 1000 trees, beside a meadow of AREA m2 (TILES x 1000), with viewers and lidars at PLACES (8),
       which see people and tracks within RANGE m (500)"""
import collections
import contextlib
import os
import struct
import sys
import threading
import time

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from std_msgs.msg import Header
from vegetation_sim.msg import SensorInterest, Viewer

from forest_rig import RATE, start_node, stop, time_of
from waiting import SimulatedClock, wait_for

FIRST, WARM_UP, SIZE = 30000, 150, 200.0  # ticks; side of a tile [m]
LIDAR_RANGE = 30.0  # [m]
LOOK_PERIOD = 7  # ticks between measurements of memory, at all phases of the key frames
FRAME_TIME, MODAL_TREES = 8.0, 64  # budgets of all shards together [ms]
LISTENERS = {'display': ('/forest/view', '/grass/near', '/agents/view'),
             'lidar': ('/forest/state', '/grass/near', '/agents/near'),
             'listener to all': ('/forest/state', '/grass/state', '/agents')}
AWAITED = '/forest/state', '/grass/state', '/agents'  # at each tick


def write_scene(path, tiles, walkers, area):
    """Writes a world that is as dense at any size: the number of tiles is a square's."""
    side = round(tiles ** 0.5)
    half = 0.5 * SIZE * side
    meadow = 0.5 * area ** 0.5
    nodes = int(2.0 * meadow / 4.0) + 1
    species = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../../../config/species')
    with open(path, 'w', encoding='utf-8') as file:
        file.write('''frame_id: map
seed: 9
forest:
  species: [{file: %s/birch.yaml}, {file: %s/pine.yaml}]
  tiles:
    - {x: %g, y: %g, size: %g, rows: %d, columns: %d, count: 1000, mix: {birch: 1, pine: 1}}
grass:
  {resolution: 4.0, origin_x: %g, origin_y: %g, columns: %d, rows: %d, height: {value: 0.3}, density: {value: 300},
   treading: {memory_cap: 4.0e+9}}  # does not bind, so that the ground of all shards is that of one
crowd:
  area: {min_x: %g, max_x: %g, min_y: %g, max_y: %g}
  groups: [{count: %d, x: 0, y: 0, spread: %g}]
wind: {primitives: [{name: breeze, kind: breeze, velocity: [4.0, 1.0, 0.0]}]}
''' % (species, species, -half, -half, SIZE, side, side, -meadow, -meadow, nodes, nodes, -meadow, meadow, -meadow,
       meadow, walkers, meadow))


def memory_of(process):
    """Returns the memory of a process [MB]: proportional set size, resident memory in which a page that several
    processes have counts once in all."""
    with open('/proc/%d/smaps_rollup' % process.pid, encoding='utf-8') as file:
        return sum(float(line.split()[1]) for line in file if line.startswith('Pss:')) * 1024 / 1e6


def cost_of(process):
    """Returns the processor time [s] and the resident memory [MB] of a process."""
    with open('/proc/%d/stat' % process.pid, encoding='utf-8') as file:
        fields = file.read().rsplit(')', 1)[1].split()
    ticks = int(fields[11]) + int(fields[12])
    return ticks / os.sysconf('SC_CLK_TCK'), int(fields[21]) * os.sysconf('SC_PAGE_SIZE') / 1e6


@contextlib.contextmanager
def on(processors):
    """What starts inside runs on these processors."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, processors)
    yield
    os.sched_setaffinity(0, before)


def idle_shares(processes, seconds=5.0):
    """Returns which share of a processor each process needs while the clock stands still, by pid."""
    before = {process.pid: cost_of(process)[0] for process in processes}
    threading.Event().wait(seconds)
    return {process.pid: (cost_of(process)[0] - before[process.pid]) / seconds for process in processes}


class Counter:
    """Counts the bytes of a topic, and its messages by stamp."""

    def __init__(self, topic, has_header):
        self.bytes, self.stamps, self._has_header = 0, collections.Counter(), has_header
        self._lock = threading.Lock()  # each publisher has a thread
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._on_message, tcp_nodelay=True)

    def publishers(self):
        return self._subscriber.get_num_connections()

    def _on_message(self, raw):
        # A header has the stamp after its sequence number.
        stamp = rospy.Time(*struct.unpack_from('<II', raw._buff, 4)) if self._has_header else None
        with self._lock:
            self.bytes += len(raw._buff)
            self.stamps[stamp] += 1


def main():
    folder, (tiles, walkers, shards, ticks) = sys.argv[1], map(int, sys.argv[2:6])
    area, places, view_range = map(int, sys.argv[6:] or (1000 * tiles, 8, 500))
    processors = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(0, processors[:-1] or processors)
    rospy.init_node('measure_shards')
    scene = os.path.join(folder, 'scene.yaml')
    write_scene(scene, tiles, walkers, area)
    forests, meadows = [], []
    others = [start_node('wind_broadcaster', '/wind_broadcaster', {}, scenario=scene),
              start_node('agent_crowd', '/agent_crowd', {}, scenario=scene, most_walkers=100000,
                         view_range=view_range, tf_budget=0)]
    # A shard would have a machine of its own, where no other waits for the same memory. On one
    # processor none does either.
    for index in range(shards):
        share = dict(scenario=scene, shard=dict(index=index, count=shards))
        # Shards have equal parts of the budgets of one node.
        with on(processors[-1:]):
            forests.append(start_node('forest_animator', '/forest_%d' % index, {}, modal_trees=MODAL_TREES // shards,
                                      frame_time=FRAME_TIME / shards, **share))
            meadows.append(start_node('grass_field', '/grass_%d' % index, {}, state_bytes=1000000000,
                                      cover_resolution=1.0, view_range=view_range, **share))
    counters = {topic: Counter(topic, topic in AWAITED)
                for topics in LISTENERS.values() for topic in topics}
    viewers = rospy.Publisher('/viewer', Viewer, queue_size=100)
    sensors = rospy.Publisher('/forest/sensors', SensorInterest, queue_size=100)
    clock = SimulatedClock()
    clock.wait_for_listeners(2 * shards + 3)
    wait_for(lambda: sensors.get_num_connections() >= shards, 'readers of sensors')
    for topic, counter in counters.items():
        count = 1 if topic.startswith('/agents') else shards
        wait_for(lambda c=counter, n=count: c.publishers() >= n, 'publishers of ' + topic)

    def run(first, last, look=lambda: None):
        for tick in range(first, last):
            if tick % 15 == 0:
                # One place in the middle and others on the diagonal of the inner quarter, so that
                # they are the same in a world that is larger.
                for i in range(places):
                    place = (i - places // 2) * 0.05 * SIZE * 8
                    header = Header(frame_id='map')
                    viewers.publish(Viewer(header=header, id='viewer_%d' % i, field_of_view=0.8, height=900,
                                           pose=Pose(Point(place, place, 2.0), Quaternion(w=1.0))))
                    sensors.publish(SensorInterest(header=header, id='sensor_%d' % i, range=LIDAR_RANGE, tolerance=0.02,
                                                   position=Point(place, place, 1.5)))
            stamp = time_of(tick)
            clock.set(stamp + rospy.Duration(0.5 / RATE))
            for topic in AWAITED:
                count = 1 if topic == '/agents' else shards
                wait_for(lambda t=topic, s=stamp, n=count: counters[t].stamps[s] >= n, '%s %s' % (topic, stamp))
            # Buffers of messages come and go with the key frames, each second.
            if tick % LOOK_PERIOD == 0:
                look()

    run(FIRST, FIRST + WARM_UP)
    idle = idle_shares(forests + meadows)
    before, begin = {process.pid: cost_of(process)[0] for process in forests + meadows}, time.monotonic()
    for counter in counters.values():
        counter.bytes = 0
    memory = {'forest': [], 'grass': []}  # of all shards at a time [MB]

    def look():
        for name, processes in (('forest', forests), ('grass', meadows)):
            memory[name].append(sum(memory_of(process) for process in processes))

    run(FIRST + WARM_UP, FIRST + WARM_UP + ticks, look)
    waited = time.monotonic() - begin
    for name, processes in (('forest', forests), ('grass', meadows)):
        costs = [cost_of(process) for process in processes]
        # A tick takes longer here than a tick of real time, in which a process waits less.
        more = [idle[process.pid] * (ticks / RATE - waited) for process in processes]
        times = [1000.0 * (cost[0] - before[process.pid] + extra) / ticks
                 for cost, process, extra in zip(costs, processes, more)]
        print('%d shards, %s: %.2f ms of processor time for a tick in all, %.2f at most; %.0f MB of memory in all, '
              '%.0f MB at the highest of %d times, %.0f MB resident, %.0f at most (%.1f ms a second without ticks)' % (
                  shards, name, sum(times), max(times), sum(memory[name]) / len(memory[name]), max(memory[name]),
                  len(memory[name]),
                  sum(cost[1] for cost in costs), max(cost[1] for cost in costs),
                  1000.0 * sum(idle[process.pid] for process in processes)))
    for listener, topics in LISTENERS.items():
        rates = [counters[topic].bytes * RATE / ticks / 1000.0 for topic in topics]
        print('%d trees, %d walkers, %s: %.0f kB/s (%s)' % (
            1000 * round(tiles ** 0.5) ** 2, walkers, listener, sum(rates),
            ', '.join('%s %.0f' % pair for pair in zip(topics, rates))))
    sys.stdout.flush()
    for process in forests + meadows + others:
        stop(process)


if __name__ == '__main__':
    main()
