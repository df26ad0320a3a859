# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Good requests and messages at random times, as users and their programs send them."""
import contextlib
import math
import threading

import rospy
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure
from geometry_msgs.msg import Point, PointStamped, Vector3, Vector3Stamped
from vegetation_sim import srv
from vegetation_sim.msg import AgentSpawn, TreadEvent, Viewer, WindPrimitive

PERIODS = 0.2, 1.0     # [s] of wall time between two requests
MOST_WALKERS = 12
FANS = 'fan_0', 'fan_1', 'fan_2'
KEPT_WINDS = 8  # at least as many as the forest keeps
SETTINGS = (('forest_animator', 'robot_tolerance', 0.02, 0.1),
            ('grass_field', 'tread_recovery', 20.0, 90.0),
            ('canopy_animator', 'frequency', 0.8, 2.0),
            ('agent_crowd', 'pace', 0.8, 1.4),
            ('wind_broadcaster', 'breeze_speed', 2.0, 7.0))


class Visitors(threading.Thread):
    """Sends one request after the other. Nodes that are down do not answer, which is no fault."""

    def __init__(self, clock, random):
        super().__init__(daemon=True)
        self.sent = self.refused = self.unanswered = 0
        self._clock, self._random, self._ended = clock, random, threading.Event()
        self._walkers, self._grabs = [], []
        self._rests = threading.Lock()  # held while nothing is sent
        self._viewer = rospy.Publisher('/viewer', Viewer, queue_size=10)
        self._tread = rospy.Publisher('/tread', TreadEvent, queue_size=100)
        self._visits = (self.spawn, self.send_walkers, self.tread, self.clear, self.blow, self.push,
                        self.grab, self.look, self.tune, self.sample, self.walk)

    def run(self):
        while not self._ended.wait(self._random.uniform(*PERIODS)):
            with self._rests:
                self._send(self._random.choice(self._visits))

    def _send(self, visit):
        try:
            visit()
            self.sent += 1
        except (rospy.ServiceException, rospy.ROSException):
            self.unanswered += 1

    @contextlib.contextmanager
    def rest(self):
        """Sends nothing meanwhile, after all that lasts was undone. The memory of nodes depends on
        it: in a stronger wind the forest simulates its trees in more detail, and it keeps some winds
        that have passed."""
        with self._rests:
            if self._grabs:
                self._send(self.grab)
            if self._walkers:
                self._send(self.remove_walkers)
            for fan in FANS:
                self._send(lambda name=fan: self.remove_fan(name))
            for node, name, low, high in SETTINGS:
                for value in (high, low) * KEPT_WINDS:
                    self._send(lambda setting=(node, name, value): self.set_parameter(*setting))
            yield

    def stop(self):
        self._ended.set()
        self.join()

    def _call(self, service, kind, /, **request):
        answer = rospy.ServiceProxy(service, kind)(**request)
        self.refused += not getattr(answer, 'success', True)
        return answer

    def _place(self):
        return Point(self._random.uniform(-4.5, 4.5), self._random.uniform(-4.5, 4.5), 0.0)

    def spawn(self):
        if len(self._walkers) >= MOST_WALKERS:
            self.remove_walkers()
            return
        like = AgentSpawn(position=self._place())
        self._walkers += self._call('/agent_crowd/spawn', srv.SpawnAgents, like=like, count=2,
                                    spread=1.0).ids

    def remove_walkers(self):
        self._call('/agent_crowd/remove', srv.RemoveAgents, ids=self._walkers)
        self._walkers = []

    def send_walkers(self):
        if self._walkers:
            self._call('/agent_crowd/set_goal', srv.SetAgentGoal, ids=self._walkers[:2],
                       goal=PointStamped(point=self._place()))

    def tread(self):
        self._call('/grass_field/tread', srv.Tread, points=[self._place(), self._place()])

    def clear(self):
        self._call('/grass_field/clear', srv.ClearGrass, radius=self._random.uniform(0.5, 3.0),
                   centre=PointStamped(point=self._place()))

    def blow(self):
        name = self._random.choice(FANS)
        if self._random.random() < 0.3:
            self.remove_fan(name)
            return
        source = WindPrimitive(name=name, kind=WindPrimitive.DISK, radius=20.0, omega=3.0,
                               velocity=Vector3(self._random.uniform(1, 6), 0.0, 0.0),
                               fade_in=0.5, fade_out=0.5)
        self._call('/wind_broadcaster/set_primitive', srv.SetWindPrimitive, primitive=source)

    def remove_fan(self, name):
        self._call('/wind_broadcaster/remove_primitive', srv.RemoveWindPrimitive, name=name)

    def push(self):
        force = Vector3Stamped(vector=Vector3(self._random.uniform(-40, 40), 0.0, 0.0))
        self._call('/forest_animator/apply_force', srv.ApplyForce, tree=self._random.randrange(2),
                   branch=self._random.randrange(1, 5), along=0.1, force=force, duration=0.5)

    def grab(self):
        if self._grabs:
            self._call('/forest_animator/release', srv.Release, id=self._grabs.pop())
            return
        answer = self._call('/forest_animator/grab', srv.Grab, nearest=True, keep_offset=True,
                            point=PointStamped(point=Point(-3.0, -4.0, 1.5)), frame='arm')
        if answer.success:
            self._grabs.append(answer.id)

    def look(self):
        message = Viewer(id='visitor', field_of_view=0.8, height=900)
        message.header.frame_id = 'map'
        message.pose.position = Point(-8.0, self._random.uniform(-2.0, 2.0), 1.6)
        message.pose.orientation.w = 1.0
        self._viewer.publish(message)

    def tune(self):
        node, name, low, high = self._random.choice(SETTINGS)
        self.set_parameter(node, name, self._random.uniform(low, high))

    def set_parameter(self, node, name, value):
        self._call('/%s/set_parameters' % node, Reconfigure,
                   config=Config(doubles=[DoubleParameter(name, value)]))

    def sample(self):
        place = self._place()
        self._call('/grass_field/sample', srv.SampleGrass, points=[place])
        self._call('/canopy_animator/sample', srv.SampleCanopy, points=[place])
        self._call('/wind_broadcaster/sample', srv.SampleWind, positions=[place])
        self._call('/forest_animator/get_tree', srv.GetTree, tree=0)

    def walk(self):
        angle = self._clock.now
        message = TreadEvent(source='visitor', position=Point(3 * math.cos(angle),
                                                              3 * math.sin(angle), 0.0))
        message.header.frame_id = 'map'
        self._tread.publish(message)
