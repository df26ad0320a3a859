# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests that replay a bag."""
import math
import subprocess

import rosbag

from forest_rig import RATE, Animator, start_animator, stop, time_of

SPEED = 10  # rate of the replay relative to wall time
# [s] of simulated time by which the replay runs behind its events; one second of wall time
DELAY = 10.0


def tick_after(path, topics):
    """Returns the first tick after all messages of the bag on these topics. The clock of the player
    stops before it."""
    with rosbag.Bag(path) as bag:
        last = max(stamp for _, _, stamp in bag.read_messages(topics))
    return math.ceil(last.to_sec() * RATE) + 1


def replay(bag, clock, scenario, last):
    """Runs another forest_animator, /replay/forest_animator, that receives only the winds and
    events in the bag, until it has published the state of the stamp `last`. Returns its states."""
    process = start_animator('/replay/forest_animator', {}, scenario=scenario, replay=True,
                             replay_delay=DELAY)
    try:
        forest = Animator('/replay/forest_animator', '/replay/')
        forest.expect_replay()
        forest.wait_until_up()
        subprocess.run(['rosbag', 'play', '-q', '--clock', '-r', str(SPEED), '-d', '1', bag,
                        '--topics', '/wind', '/forest/events', '/wind:=/replay/wind',
                        '/forest/events:=/replay/forest/events'], check=True, timeout=120,
                       stdout=subprocess.DEVNULL)
        # The clock of the bag ends before the delay has passed, so the test continues it.
        end = tick_after(bag, ['/wind', '/forest/events'])
        for tick in range(1, int((DELAY + 1) * RATE)):
            clock.show(end + tick)
        forest.state.wait(lambda all: all and all[-1].header.stamp >= last, 'the end')
        forest.close()
        return forest.states()
    finally:
        stop(process)


def compare_replay(test, read):
    """Runs a test on until the node `test.again`, which replays the other, has reached this tick.
    `read` returns the states of both nodes by stamp. Returns the number of stamps that both have,
    and those at which they differ."""
    end = time_of(test.clock.tick)
    test.run_ticks(16)  # The replay runs half a second behind.
    test.again.state.wait(lambda all: any(m.header.stamp == end for m in all), 'the end',
                          lambda: test.clock.show(test.clock.tick))
    run, replay = read()
    both = sorted(set(run) & set(replay))
    return len(both), [stamp for stamp in both if run[stamp] != replay[stamp]]
