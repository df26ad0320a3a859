# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Lock-step with the nodes: time goes on when a program says so, for training."""
import threading

import rospy
from rosgraph_msgs.msg import Clock

from vegetation_sim.client import VegetationError

NANOSECONDS = 1000000000
# A jump back that is longer restarts the nodes for sure, and cover maps that are still on their way
# are later than the first ticks after it [ns].
RESTART = NANOSECONDS * 2 // 5
PAUSE = 0.01                # between two looks at connections [s]
REMINDER = 0.5              # after which the time of a tick is published again [s of wall time]


class Simulation:
    """Publishes the clock, tick by tick, and waits after each tick until every watched topic has
    a message with the stamp of the tick. Nothing else may publish /clock, and /use_sim_time has
    to be true. A request to a node between two steps takes effect at the next tick."""

    def __init__(self, watch, rate=30, start=1000.0, timeout=30.0, delay=0.0):
        """`watch` has the message type of each topic that nodes publish at every tick, such as
        {'agents': AgentStates}. `rate` is the nodes' state_rate [Hz], `start` the time of reset()
        [s], `timeout` limits each wait [s of wall time], `delay` is the nodes' replay_delay [s]."""
        self.rate, self.timeout = rate, timeout
        self.delay = rospy.Duration.from_sec(delay)
        self.start = -(-round(start * NANOSECONDS) * rate // NANOSECONDS)  # tick of reset()
        self.tick = None
        self._condition = threading.Condition()
        self._newest = {}
        self._subscribers = {
            rospy.resolve_name(topic): rospy.Subscriber(
                topic, kind, self._on_message, rospy.resolve_name(topic), queue_size=100,
                tcp_nodelay=True)
            for topic, kind in watch.items()}
        self._clock = rospy.Publisher('/clock', Clock, queue_size=100, tcp_nodelay=True)
        self._connect()

    def reset(self):
        """Restarts the nodes: each becomes what a fresh start at the start time would be. Returns
        what observe() does."""
        return self._restart(self.start)

    def seek(self, stamp):
        """Restarts the nodes at the tick of a stamp; then a snapshot of this stamp can be loaded.
        Returns what observe() does."""
        return self._restart(stamp.to_nsec() * self.rate // NANOSECONDS)

    def step(self, ticks=1):
        """Lets time go on. Returns what observe() does."""
        for _ in range(ticks):
            self._run(self.tick + 1)
        return self.observe()

    def observe(self):
        """Returns the messages of the last tick by resolved topic."""
        with self._condition:
            return dict(self._newest)

    def stamp(self, tick=None):
        """Returns the stamp of a tick, or of the last one."""
        # The grid of ticks rounds up.
        at = -(-(self.tick if tick is None else tick) * NANOSECONDS // self.rate)
        return rospy.Time(at // NANOSECONDS, at % NANOSECONDS)

    def close(self):
        for subscriber in self._subscribers.values():
            subscriber.unregister()
        self._clock.unregister()

    def _restart(self, tick):
        if self.tick is not None:
            self.step(max(0, tick + self.rate * RESTART // NANOSECONDS + 2 - self.tick))
        return self._run(tick)

    def _run(self, tick):
        with self._condition:
            self._newest.clear()
        self.tick = tick
        stamp = self.stamp()
        for _ in range(max(1, round(self.timeout / REMINDER))):
            # A node that has just started may have missed it before.
            self._clock.publish(Clock(stamp + self.delay))
            with self._condition:
                if self._condition.wait_for(lambda: self._has_all(stamp),
                                            min(REMINDER, self.timeout)):
                    return dict(self._newest)
        with self._condition:
            missing = sorted(set(self._subscribers) - set(self._newest))
        raise VegetationError('tick %d at %.9f s: no message within %g s on %s' % (
            tick, stamp.to_sec(), self.timeout, ', '.join(missing)))

    def _has_all(self, stamp):
        return len(self._newest) == len(self._subscribers) and all(
            message.header.stamp == stamp for message in self._newest.values())

    def _on_message(self, message, topic):
        with self._condition:
            self._newest[topic] = message
            self._condition.notify_all()

    def _connect(self):
        """Waits until every watched topic has a publisher that hears the clock."""
        pause = threading.Event()
        for _ in range(max(1, int(self.timeout / PAUSE))):
            missing = self._unconnected()
            if not missing:
                return
            pause.wait(PAUSE)
        raise VegetationError('not connected within %g s: %s' % (
            self.timeout, '; '.join(missing)))

    def _unconnected(self):
        publishers = dict(rospy.get_master().getSystemState()[2][0])
        hearing = {connection.endpoint_id for connection in self._clock.impl.connections}
        missing = []
        for topic, subscriber in self._subscribers.items():
            nodes = publishers.get(topic, [])
            if not nodes or subscriber.get_num_connections() < len(nodes):
                missing.append('topic ' + topic)
            missing += ['node %s to /clock' % node for node in nodes if node not in hearing]
        return missing
