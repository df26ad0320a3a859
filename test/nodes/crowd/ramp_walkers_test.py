#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""People on a slope (S2-30, S2-34, S2-36, S2-37, N9): their steps press the grass there and nowhere
else, at the height of the ground, and slope and grass slow them down until it is trodden."""
import math
import unittest

import rospy
import rostest
from vegetation_sim.msg import AgentSpawn, GrassEvent, TreadEvent

from crowd_rig import Crowd, at, distance
from forest_rig import RATE, TickClock, time_of
from grass_rig import FULL, Meadow
from waiting import wait_for
from watched_node import listens

START = 1000 * RATE  # tick
WALK = 8  # [s]
RISE = 0.3  # of the ground to the east
CLIMBS, ALONG, CLIMBS_BESIDE, ALONG_BESIDE, FOLLOWS = range(5)  # walkers


class Ramp:
    """A crowd on its meadow, in a namespace."""

    def __init__(self, namespace):
        self.crowd = Crowd(namespace + 'agent_crowd', namespace)
        self.grass = Meadow(namespace + 'grass_field', namespace)
        self.nodes = self.crowd, self.grass
        self.crowd.wait_until_up()
        self.grass.wait_until_up(namespace + 'treads')
        cover = namespace + 'grass/cover/resistance'
        wait_for(lambda: listens(self.crowd.process, cover), 'the cover')

    def treads(self, walker=None):
        """Returns the treads that the crowd published, of one walker if it is given."""
        name = 'walker_%s' % walker
        return [t for t in self.crowd.tread_events() if walker is None or t.source.startswith(name)]

    def all_arrived(self):
        """Returns whether the meadow has taken all treads."""
        taken = [e for e in self.grass.events.messages if e.kind == GrassEvent.TREAD]
        return len(taken) == len(self.treads())

    def law(self):
        """Returns the law of the treads with their defaults."""
        return next(e.tread.law for e in self.grass.events.messages if e.kind == GrassEvent.TREAD)

    def position(self, walker, tick):
        """Returns the position of a walker at a tick."""
        message = next(m for m in self.crowd.state.messages if m.header.stamp == time_of(tick))
        return next(a.pose.position for a in message.agents if a.id == walker)

    def way(self, walker, first, last):
        """Returns how far a walker came between two times since the start [s]."""
        ticks = (START + 1 + RATE * first, START + 1 + RATE * last)
        return distance(*(self.position(walker, tick) for tick in ticks))


def segments_of(treads):
    """Returns the ways of the sources of treads as pairs of places."""
    if treads[0].action == TreadEvent.STROKE:
        return [((t.start.x, t.start.y), (t.position.x, t.position.y)) for t in treads]
    places = [(t.position.x, t.position.y) for t in treads]
    return list(zip(places, places[1:]))


def gap(place, segment):
    """Returns the distance of a place from a segment [m]."""
    (ax, ay), (bx, by) = segment
    dx, dy, px, py = bx - ax, by - ay, place[0] - ax, place[1] - ay
    share = max(0.0, min(1.0, (px * dx + py * dy) / (dx * dx + dy * dy)))
    return math.hypot(px - share * dx, py - share * dy)


class RampWalkers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        clock = TickClock(START)
        cls.ramps = [Ramp('/body/'), Ramp('/feet/')]
        cls.body, cls.feet = cls.ramps
        nodes = cls.body.nodes + cls.feet.nodes
        clock.run(1 + WALK * RATE, *nodes)
        cls.errors = cls.body.crowd.predicted_errors('/body/agents/errors')
        for ramp in cls.ramps:
            follower = AgentSpawn(position=at(8, -18), heading=0.5 * math.pi, has_goal=True, goal=at(8, 40))
            ramp.spawned = ramp.crowd.spawn(like=follower, count=1)
        clock.run(WALK * RATE, *nodes)
        # A tread of the last tick takes effect at the next one, at which people tread again.
        for ramp in cls.ramps:
            ramp.crowd.remove(all=True)
        clock.run_until(lambda: all(not r.crowd.state.messages[-1].agents and r.all_arrived() for r in cls.ramps),
                        'a meadow that has taken all treads', *nodes)

    def test_people_and_their_treads_are_on_the_ground(self):
        for ramp in self.ramps:
            agents = [a for m in ramp.crowd.state.messages for a in m.agents]
            self.assertGreater(len(agents), 4 * WALK * RATE)
            places = [a.pose.position for a in agents] + [f for a in agents for f in a.feet]
            places += [t.position for t in ramp.treads()]
            places += [t.start for t in ramp.treads() if t.action == TreadEvent.STROKE]
            self.assertLess(max(abs(p.z - RISE * p.x) for p in places), 1e-6)

    def test_errors_of_the_view_are_those_of_limbs(self):  # N9
        """The rounding moves a point by up to 0.87 mm, a limb on the slope farther."""
        self.assertTrue(0.001 < self.errors['agents/view'].metres < 0.03, self.errors['agents/view'])

    def test_a_body_presses_its_track_and_nothing_else(self):
        self.expect_pressed(self.body, 0.9 * FULL)

    def test_feet_press_where_they_stand_and_nothing_else(self):
        treads = self.feet.treads(CLIMBS)
        self.assertGreater(len(treads), 8)
        self.assertEqual({t.source for t in treads}, {'walker_0_left', 'walker_0_right'})
        self.expect_pressed(self.feet, 0.5 * FULL)

    def expect_pressed(self, ramp, pressed):
        """Compares the tilt of the grass around the climber's way with the distance from it."""
        segments = segments_of(ramp.treads(CLIMBS))
        law = ramp.law()
        self.assertTrue(law.has_radius and law.has_reach)
        far = law.reach + 0.1  # the diagonal of the nodes of the trodden ground
        end = max(x for segment in segments for x, _ in segment)
        places = [(-11.5 + 0.05 * i, -1.5 + 0.05 * j) for i in range(int(20 * (end + 13))) for j in range(61)]
        gaps = [min(gap(place, segment) for segment in segments) for place in places]
        samples = list(zip(gaps, ramp.grass.samples(places)))
        self.assertTrue(all(abs(s.position.z - RISE * s.position.x) < 1e-6 for _, s in samples))
        under = [s.tilt for g, s in samples if g < 0.4 * law.radius]
        beyond = [s.tilt for g, s in samples if g > far]
        self.assertGreater(len(under), 20)
        self.assertGreater(len(beyond), 1000)
        self.assertGreater(min(under), pressed)
        self.assertEqual(max(beyond), 0.0)

    def test_people_climb_slowly(self):
        for ramp in self.ramps:
            climbed, along = (ramp.way(walker, 3, 8) for walker in (CLIMBS_BESIDE, ALONG_BESIDE))
            tobler = math.exp(3.5 * (0.05 - abs(RISE + 0.05)))
            self.assertAlmostEqual(climbed / along, tobler, delta=0.02)
            # A climber's own treads, of half a metre ahead, leave little of the grass before it.
            self.assertLess(ramp.way(CLIMBS, 3, 8), climbed - 0.02)

    def test_grass_slows_people_until_it_is_trodden(self):
        ahead, behind = self.body.way(ALONG, 1, 6), self.body.way(FOLLOWS, 1 + WALK, 6 + WALK)
        beside = self.body.way(ALONG_BESIDE, 1, 6)
        self.assertLess(ahead, 0.85 * beside)
        self.assertGreater(behind, 0.9 * beside)


if __name__ == '__main__':
    rospy.init_node('ramp_walkers_test')
    rostest.rosrun('vegetation_sim', 'ramp_walkers', RampWalkers)
