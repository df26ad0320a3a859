# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Any tick of a recorded run, by a replay of its events."""
import threading

import rosbag
import roslib.message
import rospy

from vegetation_sim.client import VegetationError
from vegetation_sim.simulation import NANOSECONDS, Simulation

LEAD = 1   # time by which the replay begins before the run, and has its inputs before their ticks [s]
PAUSE = 0.01  # between two looks at connections [s]


class Recording:
    """Brings nodes with ~replay to any tick of a run whose bag has /clock, the topics of the nodes'
    states, and what the nodes take as input, `*/events` above all. The bag has to begin before the
    first tick of the nodes, and the conditions are those of Simulation."""

    def __init__(self, path, watch, rate=30, delay=0.5, timeout=30.0):
        """`path` of the bag; `watch` has the message types of the state topics, such as
        {'agents': AgentStates}; `rate` and `delay` are the nodes' state_rate [Hz] and replay_delay
        [s]; `timeout` limits each wait [s of wall time]."""
        self.path, self.timeout = path, timeout
        self._sent = 0
        self._hashes, self._inputs = self._read([rospy.resolve_name(topic) for topic in watch])
        stamps = [stamp for hashes in self._hashes.values() for stamp in hashes]
        if not stamps:
            raise VegetationError('%s: no message on %s' % (path, ', '.join(sorted(watch))))
        self.first, self.last = (rospy.Time(*divmod(stamp, NANOSECONDS))
                                 for stamp in (min(stamps), max(stamps)))
        self._publishers = {}
        self._simulation = Simulation(watch, rate, self.first.to_sec() - LEAD, timeout, delay)
        self._connect()

    def seek(self, stamp):
        """Runs the replay until the tick of a stamp, from the start if that is before the present
        tick. Returns the messages of the tick by resolved topic. Raises VegetationError if the
        stamp is not in the recording, or the state has another hash than the recorded one."""
        if not self.first <= stamp <= self.last:
            raise VegetationError('%s: stamp = %.9f s is outside %.9f to %.9f s' % (
                self.path, stamp.to_sec(), self.first.to_sec(), self.last.to_sec()))
        simulation = self._simulation
        tick = stamp.to_nsec() * simulation.rate // NANOSECONDS
        if simulation.tick is None or simulation.tick > tick:
            simulation.reset()
            self._sent = 0
        while simulation.tick < tick:
            self._send(simulation.stamp() + rospy.Duration(LEAD))
            simulation.step()
        found = simulation.observe()
        self._compare(found)
        return found

    def close(self):
        self._simulation.close()
        for sender in self._publishers.values():
            sender.unregister()

    def _read(self, watched):
        """Returns the recorded hashes by topic and stamp, and the inputs by time."""
        taken = {topic for topic, _ in rospy.get_master().getSystemState()[2][1]}
        hashes, inputs = {topic: {} for topic in watched}, []
        try:
            with rosbag.Bag(self.path) as bag:
                for topic, message, time in bag.read_messages():
                    if topic in hashes:
                        hashes[topic][message.header.stamp.to_nsec()] = message.hash
                    elif topic in taken and topic != '/clock':
                        inputs.append((time, topic, message))
        except (OSError, rosbag.ROSBagException) as error:
            raise VegetationError('%s: cannot be read: %s' % (self.path, error)) from error
        return hashes, inputs

    def _connect(self):
        """Waits until each input has a reader."""
        for _, topic, message in self._inputs:
            if topic not in self._publishers:
                kind = roslib.message.get_message_class(message._type)
                if kind is None or kind._md5sum != message._md5sum:
                    raise VegetationError('%s: %s has messages of another version of %s' % (
                        self.path, topic, message._type))
                self._publishers[topic] = rospy.Publisher(topic, kind, queue_size=None,
                                                          tcp_nodelay=True)
        pause = threading.Event()
        for _ in range(max(1, int(self.timeout / PAUSE))):
            missing = [topic for topic, sender in self._publishers.items()
                       if sender.get_num_connections() == 0]
            if not missing:
                return
            pause.wait(PAUSE)
        raise VegetationError('no reader within %g s: %s' % (
            self.timeout, ', '.join(sorted(missing))))

    def _send(self, until):
        """Publishes the inputs that were recorded until a time."""
        while self._sent < len(self._inputs) and self._inputs[self._sent][0] <= until:
            _, topic, message = self._inputs[self._sent]
            self._publishers[topic].publish(message)
            self._sent += 1

    def _compare(self, found):
        for topic, message in found.items():
            recorded = self._hashes[topic].get(message.header.stamp.to_nsec())
            if recorded not in (None, message.hash):
                raise VegetationError('%s: the state at %.9f s on %s differs from the recorded one'
                                      % (self.path, message.header.stamp.to_sec(), topic))
