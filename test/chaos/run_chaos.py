#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the six nodes with random faults, and then replays of the events that they accepted.

usage: run_chaos.py SECONDS SEED FACTOR  (simulated time, of the faults, of the clock)
Prints a table of checks, and exits with 1 if one fails.
"""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import types

import rosgraph
import rospy
from vegetation_sim.srv import SaveSnapshot

from checks import check_all
from clock import FastClock
from diagnosis import Diagnosis
from faults import IN_TRANSIT, Faults, pause
from processes import Processes
from recording import Recording
from replay import Replay
from robot import Robot
from scene import NODES, SIMULATIONS, START
from visitors import Visitors
from waiting import wait_for
from watches import MemoryWatch, TickWatch

FOLDER = os.path.dirname(os.path.abspath(__file__))
CALM = 5.0  # of simulated time before the first and after the last fault [s]
KILLING = 1.0 / 3.0  # part of the time in which nodes are killed; then memory can be measured
KEPT = os.path.join('build', 'chaos')  # folder of the results
QUIET = subprocess.DEVNULL


def start_ros(folder):
    """Starts a master and the nodes. Returns both processes."""
    master = subprocess.Popen(['roscore'], stdout=QUIET, stderr=QUIET)
    log = open(os.path.join(folder, 'nodes.log'), 'w', encoding='utf-8')
    nodes = subprocess.Popen(['roslaunch', '--wait', os.path.join(FOLDER, 'chaos.launch'),
                              'snapshot_folder:=' + folder], stdout=log, stderr=log)
    return master, nodes


def stop(process):
    process.send_signal(signal.SIGINT)
    process.wait()


def make_rig(nodes, folder, factor, seed):
    """Returns all parts of the test, connected to nodes whose clock has not begun."""
    rig = types.SimpleNamespace(folder=folder, processes=Processes(nodes.pid), robot=Robot())
    rig.recording, rig.ticks, rig.diagnosis = Recording(), TickWatch(), Diagnosis()
    wait_for(lambda: rig.recording.connected() and rig.ticks.connected(), 'the nodes')

    def lag(now):
        return rig.ticks.lag(now, {node for node in NODES if rig.processes.is_disturbed_now(node)})
    rig.clock = FastClock(factor, rig.robot, lag, random.Random(seed + 1))
    rig.memory = MemoryWatch(rig.processes, rig.clock, rig.diagnosis)
    rig.visitors = Visitors(rig.clock, random.Random(seed + 2))
    wait_for(lambda: rig.clock.readers() >= len(NODES), 'the readers of the clock')
    pause(1.0)  # A publisher knows its reader a little later than the reader.
    return rig


def run_live(rig, seconds, seed):
    """Runs the nodes with faults. Returns what became of the faults, and the final hashes."""
    rig.parameters = {node: rospy.get_param('/' + node) for node in SIMULATIONS}
    rig.clock.start()
    rig.memory.start()
    wait_for(lambda: all(rig.ticks.newest.values()), 'the first tick of all nodes')
    pause(CALM)
    rig.visitors.start()
    faults = Faults(rig, random.Random(seed))
    end = START + seconds
    faults.run(end - CALM, START + KILLING * seconds)
    rig.visitors.stop()
    wait_for(lambda: rig.clock.now >= end, 'the end of the clock')
    rig.clock.stop()
    rig.memory.stop()
    rig.memory.write(os.path.join(KEPT, 'memory.csv'))
    final = {node: save(rig, node) for node in SIMULATIONS}
    pause(IN_TRANSIT)
    rig.recording.complete()
    return faults.outcomes, final


def save(rig, node):
    """Returns the hash of the state of a node once it has run its last tick."""
    proxy = rospy.ServiceProxy('/%s/save_snapshot' % node, SaveSnapshot)
    stamps = []

    def has_settled():
        pause(0.2)
        stamps.append(proxy(name='final').stamp)
        rig.clock.publish(rig.clock.now)
        return len(stamps) > 3 and len(set(stamps[-3:])) == 1
    wait_for(has_settled, 'the last tick of ' + node)
    return proxy(name='final').hash


def keep_snapshots(folder, final, again):
    """Copies the final snapshots of nodes whose replay ended differently to build/chaos."""
    for node in SIMULATIONS:
        if final[node] == again[node]:
            continue
        for run, name in ('live', 'final/%s'), ('replay', 'replay/final/replay.%s'):
            target = os.path.join(KEPT, '%s_%s.snapshot' % (node, run))
            shutil.copy(os.path.join(folder, name % node + '.snapshot'), target)
            print('the final hashes differ: kept ' + target)


def main(seconds, seed, factor):
    os.makedirs(KEPT, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        master, nodes = start_ros(folder)
        try:
            wait_for(lambda: rosgraph.is_master_online(), 'the master')
            rospy.init_node('chaos', disable_rostime=True, disable_signals=True)
            rig = make_rig(nodes, folder, factor, seed)
            outcomes, final = run_live(rig, seconds, seed)
            stop(nodes)
            replays = {node: Replay(node, rig.recording, rig.parameters[node], folder)
                       for node in SIMULATIONS}
            again = {node: replay.run() for node, replay in replays.items()}
            keep_snapshots(folder, final, again)
            table = check_all(rig, outcomes, seconds, final, again, replays)
        finally:
            for process in (nodes, master):
                if process.poll() is None:
                    stop(process)
    table.show()
    return table.failures


if __name__ == '__main__':
    sys.exit(1 if main(float(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])) else 0)
