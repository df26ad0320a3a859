#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes /clock and lets time go on by services: ~step and ~reset. docs/lockstep.md describes
the parameters."""
import sys
import threading

import rospy
from std_srvs.srv import Trigger, TriggerResponse
from vegetation_sim import Simulation, VegetationError
from vegetation_sim.msg import AgentStates, CanopyState, ErrorCode, ForestState, GrassState
from vegetation_sim.srv import Step, StepResponse

KINDS = {'agents': AgentStates, 'canopy/state': CanopyState, 'forest/state': ForestState,
         'grass/state': GrassState}
MOST_TICKS = 100000


class StepClock:
    """Answers the requests, one after another."""

    def __init__(self, simulation):
        self._simulation = simulation
        self._lock = threading.Lock()  # rospy calls each service in a thread of its own

    def step(self, request):
        if not 1 <= request.ticks <= MOST_TICKS:
            return refusal(ErrorCode.INVALID_VALUE, 'ticks = %d is outside 1 to %d' % (
                request.ticks, MOST_TICKS))
        try:
            with self._lock:
                states = self._simulation.step(request.ticks)
                tick, stamp = self._simulation.tick, self._simulation.stamp()
        except VegetationError as error:
            return refusal(ErrorCode.NOT_AVAILABLE, str(error))
        topics = sorted(states)
        return StepResponse(success=True, message='tick %d' % tick, stamp=stamp, topics=topics,
                            hashes=[states[topic].hash for topic in topics])

    def reset(self, _):
        try:
            with self._lock:
                self._simulation.reset()
                return TriggerResponse(success=True, message='tick %d' % self._simulation.tick)
        except VegetationError as error:
            return TriggerResponse(success=False, message=str(error))


def refusal(code, text):
    return StepResponse(success=False, error_code=code, message=text)


def number(name, default, low, high, kinds=(int, float)):
    """Returns a parameter. Raises ValueError for one that is no number, or out of range."""
    value = rospy.get_param('~' + name, default)
    # A bool is an int for Python. No comparison with NaN is true.
    if isinstance(value, bool) or not isinstance(value, kinds) or not low <= value <= high:
        raise ValueError('%s = %s is outside %g to %g%s' % (
            name, value, low, high, ', or not whole' if kinds is int else ''))
    return value


def chosen_kinds():
    """Returns the types of the topics that each tick waits for."""
    names = str(rospy.get_param('~topics', ' '.join(KINDS))).split()
    wrong = [name for name in names if name not in KINDS]
    if wrong or not names:
        raise ValueError('topics = %r: allowed are %s' % (' '.join(wrong), ', '.join(KINDS)))
    return {name: KINDS[name] for name in names}


def main():
    rospy.init_node('step_clock')
    try:
        simulation = Simulation(chosen_kinds(), number('rate', 30, 1, 240, int),
                                number('start', 1000.0, 1.0, 1e9),
                                number('timeout', 30.0, 0.1, 3600.0), number('delay', 0.0, 0.0, 10.0))
        simulation.reset()
    except (ValueError, VegetationError) as error:
        rospy.logfatal('step_clock: %s', error)
        sys.exit(1)
    clock = StepClock(simulation)
    rospy.Service('~step', Step, clock.step)
    rospy.Service('~reset', Trigger, clock.reset)
    rospy.spin()


if __name__ == '__main__':
    main()
