# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The faults of the chaos test, one after the other, in a random order that a seed repeats. Jitter
of the clock and requests of visitors go on meanwhile."""
import signal
import threading
import time

import rospy
import rostopic

from diagnosis import warns_of
from floods import find_services, find_topics, flood_service, flood_topic
from journal import read_journal
from outcomes import Outcomes
from raw_messages import class_of_bytes, make_raw
from scene import FOLLOWERS, NODES, OWNED, SIMULATIONS
from surges import flood_queue
from waiting import wait_for

STOPS = 1.0, 3.0      # [s] of wall time
LOSS = 4.0            # duration without frames of the robot [s] of wall time
STALE = 0.5           # [s] of simulated time after which nodes call a frame lost
RIVALRY = 3.0         # duration with a second publisher [s] of wall time
KILLS = 3             # of each node, as often as any other fault once
JITTER = 3.0, 10.0    # duration of a jitter, and of the time between two [s] of wall time
IN_TRANSIT = 0.4      # [s] of wall time after which all that a dead process sent has arrived
SETTLED = 1.5         # [s] after a start; then the recorder has all connections
JOURNAL_PERIOD = 0.2  # [s] of wall time
SENSOR = 'vegetation_scanner'
IGNORED = 'Messages of other viewers'
WARM_ROUNDS = 1       # of all faults after the last kill, before memory is measured
PAUSES = 0.2, 1.5     # [s] of wall time between two faults
REST_PERIOD = 140.0   # [s] of simulated time between two rests, in which memory is measured
SETTLING = 80.0       # [s] of simulated time until the robot has parked, and what was sent
                      # before a rest has ended
REST = 110.0          # duration of a rest [s] of simulated time


def pause(seconds):
    threading.Event().wait(seconds)


class Faults:
    """Injects faults and notes which of them the diagnostics name."""

    def __init__(self, rig, random):
        self._rig, self._random = rig, random
        self.outcomes = Outcomes()
        self._topics, self._services = find_topics(), find_services()

    def run(self, until, kills_until):
        """Injects faults until a time of the clock, and kills nodes until an earlier one. Once
        every other fault has met the processes that began last, their memory is measured: each
        kind of flood needs its memory once."""
        clock, deck, rounds = self._rig.clock, [], 0
        jitter = threading.Thread(target=self._jitter, args=(until,), daemon=True)
        jitter.start()
        while clock.now < until:
            if not deck:
                deck = self._shuffled()
                rounds += clock.now >= kills_until
                if rounds == WARM_ROUNDS + 1 and self.outcomes.warm_since is None:
                    self.outcomes.warm_since = clock.now
            if self._rest_is_due(until):
                self._rest()
                continue
            kind, target = deck.pop()
            if kind == self.kill and clock.now >= kills_until:
                continue
            print('%.1f s: %s %s' % (clock.now, kind.__name__, target or ''), flush=True)
            kind(target)
            pause(self._random.uniform(*PAUSES))
        jitter.join()

    def _rest_is_due(self, until):
        rests = self.outcomes.rests
        if self.outcomes.warm_since is None or self._rig.clock.now + REST > until:
            return False
        return not rests or self._rig.clock.now >= rests[-1][1] + REST_PERIOD

    def _rest(self):
        """Lets the nodes rest, so that they hold what they keep for good. The robot parks at the same
        place each time: what the forest holds depends on the trees that it perceives and touches."""
        clock, begin = self._rig.clock, self._rig.clock.now
        print('%.1f s: rest' % begin, flush=True)
        self._rig.robot.parks = True
        with self._rig.visitors.rest():
            while clock.now < begin + REST:
                pause(0.1)
        self._rig.robot.parks = False
        self.outcomes.rests.append((begin + SETTLING, clock.now))

    def _shuffled(self):
        deck = [(self.kill, node) for node in NODES] * KILLS
        deck += [(self.stop, node) for node in NODES]
        deck += [(self.lose_frames, None)] * 3 + [(self.double, topic) for topic in OWNED]
        deck += [(self.flood_topic, topic) for topic in self._topics]
        deck += [(self.flood_service, service) for service in self._services]
        deck += [(self.surge, None)]
        self._random.shuffle(deck)
        return deck

    def _jitter(self, until):
        clock, random = self._rig.clock, type(self._random)(self._random.random())
        while clock.now < until:
            clock.jitter = not clock.jitter
            self.outcomes.injected['jitter of the clock'] += clock.jitter
            pause(random.uniform(*JITTER))
        clock.jitter = False

    def expect(self, fault, node, words, since, test=None, known=None):
        """Waits for a report after the wall time `since` and notes how long after `known` it came:
        the time at which the node could know of the fault."""
        took = self._rig.diagnosis.wait(node, test or warns_of(words), since)
        if took is not None and known is not None:
            took = max(0.0, took + since - known)
        self.outcomes.add(fault, node, words, took)

    def kill(self, node):
        rig, since = self._rig, time.monotonic()
        disturbance = rig.processes.begin(node)
        before = rig.diagnosis.newest(node, 'Sweeps')
        rig.processes.kill(node)
        pause(IN_TRANSIT)
        winds = len(rig.recording.winds_of_owner)
        if node in SIMULATIONS:
            with rig.recording.lock:
                rig.recording.nodes[node].end_process(*read_journal(rig.folder, node))
        wait_for(lambda: rig.processes.find(node), 'the start of ' + node)
        begun = time.monotonic()
        wait_for(lambda: rig.ticks.arrival[node] > max(since, begun), 'the ticks of ' + node)
        self._expect_start(node, before, begun)
        self._follow_journal(node)
        if node == 'wind_broadcaster':
            self.outcomes.add_wind(rig.recording.winds_of_owner, winds)
        disturbance[2] = time.monotonic()

    def _follow_journal(self, node):
        """Reads the journal again and again, since the next checkpoint begins it anew."""
        end = time.monotonic() + SETTLED
        while time.monotonic() < end:
            self._take_journal(node)
            pause(JOURNAL_PERIOD)

    def _take_journal(self, node):
        rig = self._rig
        if node in SIMULATIONS:
            with rig.recording.lock:
                rig.recording.nodes[node].take_journal(read_journal(rig.folder, node)[1])

    def _expect_start(self, node, before, since):
        """The scanner has no checkpoint; its counts begin anew. A fault is known with the first
        tick."""
        known = time.monotonic()
        if node != 'vegetation_scanner':
            self.expect('kill -9', node, 'continues from its checkpoint', since, known=known)
            return
        sweeps = int(before.values['Sweeps']) if before else 0
        self.expect('kill -9', node, 'Sweeps (begin anew)', since,
                    lambda report: int(report.values.get('Sweeps', sweeps)) < sweeps, known)

    def stop(self, node):
        disturbance = self._rig.processes.begin(node)
        self._rig.processes.signal(node, signal.SIGSTOP)
        pause(self._random.uniform(*STOPS))
        disturbance[2] = time.monotonic()
        self._rig.processes.signal(node, signal.SIGCONT)
        self._follow_journal(node)  # A node that catches up drops states that it cannot send.
        self.expect('SIGSTOP', node, 'no callback ran', disturbance[2])

    def lose_frames(self, _):
        rig = self._rig
        scanner = rig.processes.begin('vegetation_scanner')  # it publishes nothing without a pose
        rig.robot.lost = True
        begin = rig.clock.now
        wait_for(lambda: rig.clock.now >= begin + STALE, 'the frames to become stale')
        since = time.monotonic()
        pause(LOSS)
        rig.robot.lost = False
        scanner[2] = time.monotonic()
        for node, words in FOLLOWERS.items():
            self.expect('lost tf', node, words, since)

    def double(self, topic):
        message_class = class_of_bytes(rostopic.get_topic_class('/' + topic)[0])
        rival = rospy.Publisher('/' + topic, message_class, queue_size=10)
        wait_for(rival.get_num_connections, 'readers of ' + topic)
        since = time.monotonic()
        # The sensor may wait for the next complete state, for which time must go on.
        scanner = self._rig.processes.begin(SENSOR)
        for raw in self._rig.recording.rival_messages(topic):
            rival.publish(make_raw(message_class, raw))
        pause(RIVALRY)
        rival.unregister()
        for node in OWNED[topic]:
            self.expect('second publisher', node, 'publishers of /' + topic, since)
        end = time.monotonic()
        wait_for(lambda: self._rig.ticks.arrival[SENSOR] > end, 'a sweep')
        scanner[2] = time.monotonic()

    def flood_topic(self, topic):
        since = time.monotonic()
        tests = {node: self._test_of_flood(topic, node) for node in self._topics[topic]}
        flood = flood_topic(topic, self._random)
        for node in self._topics[topic]:
            self.expect('flood of a topic', node, 'refused input: %s' % topic, since, tests[node])
        flood.unregister()

    def _test_of_flood(self, topic, node):
        """canopy_animator counts the messages of all viewers but one, and reads no more of them."""
        before = self._rig.diagnosis.newest(node, IGNORED)
        if topic != '/viewer' or not before:
            return warns_of('refused input')
        return lambda report: warns_of('refused input')(report) or \
            int(report.values.get(IGNORED, 0)) > int(before.values[IGNORED])

    def flood_service(self, target):
        service, node = target
        since = time.monotonic()
        calls, refused, failed = flood_service(service, self._random)
        self.outcomes.requests += calls
        self.outcomes.refused += refused
        self.outcomes.unanswered += failed
        self.outcomes.injected['flood of a service'] += 1
        if not refused and not service.endswith('/set_parameters'):
            self.outcomes.credulous.add(service)
        else:
            self.expect('flood of a service', node, 'refused request: ' + service, since,
                        warns_of('refused '))

    def surge(self, _):
        since = time.monotonic()
        flood_queue(self._rig.clock.now)
        self.expect('flood of the queue', 'grass_field', 'inputs lost', since,
                    known=time.monotonic())
