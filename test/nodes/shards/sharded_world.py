# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A world in shards beside the same world in single nodes, tick by tick: what acts on both, requests,
and the sums of hashes. Shards are /forest_0, /grass_0 and so on, the single nodes
/whole/forest_all and /whole/grass_all."""
import collections
import math
import threading

import rospy
from geometry_msgs.msg import Point, PointStamped, TransformStamped, Vector3, Vector3Stamped
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ForestState, GrassCut, GrassState, SensorInterest, TreadEvent
from vegetation_sim.srv import (ApplyForce, CutBranch, CutGrass, FindBranch, GetTree, Grab, MoveGrab, Release,
                                SampleGrass, Tread)

from forest_rig import RATE, time_of
from grass_rig import step
from waiting import SimulatedClock, wait_for

FIRST, AHEAD = 1000 * RATE, 4  # first tick; how far stamps of treads and requests are ahead
MASK = (1 << 64) - 1
TREES = 16
HANDS = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]  # trunks beside the borders [m]


class States:
    """Hashes and bytes of the states of one topic, by tick."""

    def __init__(self, topic, message_type, count, hash_of):
        self.count, self.bytes = count, 0
        self.sums, self.heard = collections.Counter(), collections.Counter()
        self.arrived = threading.Condition()
        self._type, self._hash_of = message_type, hash_of
        rospy.Subscriber(topic, rospy.AnyMsg, self._on_message, tcp_nodelay=True)

    def _on_message(self, raw):
        message = self._type().deserialize(raw._buff)
        with self.arrived:
            self.bytes += len(raw._buff)
            self.sums[message.header.stamp] += self._hash_of(message)
            self.heard[message.header.stamp] += 1
            self.arrived.notify_all()

    def wait(self, stamp, count=None):
        """Waits for the states of a stamp: of `count` shards, or of all."""
        count = self.count if count is None else count
        with self.arrived:
            if not self.arrived.wait_for(lambda: self.heard[stamp] >= count, 60.0):
                raise AssertionError('no states of %s: %d of %d' % (stamp, self.heard[stamp], count))

    def hashes(self):
        """Returns the sums by stamps at which all shards were heard."""
        return {stamp: sum_ & MASK for stamp, sum_ in self.sums.items() if self.heard[stamp] == self.count}


class World:
    """All nodes of the scene, and what acts on them."""

    def __init__(self, shards, alive=None, others=4):
        """@param alive shards that run; all by default. @param others that listen to the clock: wind,
        two scanners and this process."""
        self.shards, self.tick = shards, FIRST
        self.begin = FIRST  # tick from which the frames move
        self.alive = shards if alive is None else alive
        self.states = {}
        for kind, message_type, hash_of in (('forest', ForestState, lambda m: m.trees_hash),
                                            ('grass', GrassState, lambda m: m.hash)):
            self.states[kind] = (States('/%s/state' % kind, message_type, shards, hash_of),
                                 States('/whole/%s/state' % kind, message_type, 1, hash_of))
        self.clouds = [{}, {}]
        for cloud, topic in zip(self.clouds, ('/lidar/points', '/whole/lidar/points')):
            rospy.Subscriber(topic, PointCloud2, lambda m, c=cloud: c.update({m.header.stamp: m}))
        self.announced = {}  # stamp from which the newest announcement of each lidar holds, by topic
        for topic in ('/forest/sensors', '/whole/forest/sensors'):
            rospy.Subscriber(topic, SensorInterest,
                             lambda m, t=topic: self.announced.update({t: m.header.stamp}), tcp_nodelay=True)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100, tcp_nodelay=True)
        self.tread = rospy.Publisher('/tread', TreadEvent, queue_size=1000, tcp_nodelay=True)
        self.clock = SimulatedClock()
        nodes = 2 * self.alive + 2
        self.clock.wait_for_listeners(nodes + others)
        wait_for(lambda: self.tread.get_num_connections() == self.alive + 1, 'readers of /tread')
        wait_for(lambda: self.tf.get_num_connections() >= nodes, 'readers of /tf')

    def stamp(self, ahead=0):
        return time_of(self.tick + ahead)

    def run_tick(self):
        self.clock.set(self.stamp(1) + rospy.Duration(0.5 / RATE))
        self.tick += 1
        self.wait_for_states()
        # Lidars that are late would announce themselves to the shards at different ticks.
        wait_for(lambda: all(stamp >= self.stamp(2) for stamp in list(self.announced.values())), 'lidars')

    def wait_for_states(self):
        """Waits for the states of the last tick, of all shards that are alive."""
        for divided, whole in self.states.values():
            divided.wait(self.stamp(), self.alive)
            whole.wait(self.stamp())

    def is_joined(self):
        """Returns whether each shard answers for all."""
        places = [Point(x, y, 0.0) for x in (-11.0, -1.0, 1.0, 11.0) for y in (-11.0, -1.0, 1.0, 11.0)]
        for shard in range(self.shards):
            get_tree = rospy.ServiceProxy('/forest_%d/get_tree' % shard, GetTree)
            sample = rospy.ServiceProxy('/grass_%d/sample' % shard, SampleGrass)
            if not sample(points=places).success or not all(get_tree(tree=i).success for i in range(TREES)):
                return False
        return True

    def compare(self, kind):
        """Returns how many stamps have hashes of both, those whose hashes are equal, and how many
        different hashes there are."""
        divided, whole = (states.hashes() for states in self.states[kind])
        both = sorted(stamp for stamp in whole if stamp in divided)
        equal = [stamp for stamp in both if divided[stamp] == whole[stamp]]
        return both, equal, len({whole[stamp] for stamp in both})

    def show_frames(self):
        part = max(0, self.tick - self.begin) / 300.0
        angle = 2.0 * part
        places = {'robot': (1.45 * math.cos(angle), 1.45 * math.sin(angle), 1.0),  # through the trunks of HANDS
                  'gripper': (0.2 * math.sin(angle), 0.2 * math.cos(angle), 1.9),
                  'lidar': (-8.0 * math.cos(1.2 * part), 0.3, 1.5)}
        message = TFMessage()
        for name, (x, y, z) in places.items():
            frame = TransformStamped(header=Header(stamp=self.stamp(1), frame_id='map'), child_frame_id=name)
            frame.transform.translation = Vector3(x, y, z)
            frame.transform.rotation.w = 1.0
            message.transforms.append(frame)
        self.tf.publish(message)

    def walk(self):
        for walker in range(6):
            angle = 0.02 * (self.tick - FIRST) + walker
            message = step('walker_%d' % walker, 11.0 * math.sin(angle), 11.0 * math.sin(1.4 * angle + walker))
            message.header = Header(stamp=self.stamp(AHEAD), frame_id='map')
            self.tread.publish(message)

    def ask(self, kind, shard, service, service_type, **request):
        """Sends a request through a shard, and to the single node; returns both answers."""
        out = []
        for name in ('/%s_%d' % (kind, shard), '/whole/%s_all' % kind):
            proxy = rospy.ServiceProxy('%s/%s' % (name, service), service_type)
            fields = dict(request, **({'id': request['id'][len(out)]} if 'id' in request else {}))
            answer = proxy(**fields)
            if not answer.success:
                raise AssertionError('%s/%s: %s' % (name, service, answer.message))
            out.append(answer)
        return out


def in_map(x, y, z):
    return PointStamped(header=Header(frame_id='map'), point=Point(x, y, z))


class Requests:
    """Requests through each shard in turn, for what others own."""

    def __init__(self, world):
        self.world, self.held, self.sent = world, [], 0

    def send(self, kind, service, service_type, **request):
        self.sent += 1
        return self.world.ask(kind, self.sent % self.world.shards, service, service_type, **request)

    def act(self, age):
        """Acts at the tick of this age, in a cycle of 100 ticks."""
        phase, cycle = age % 100, age // 100
        hand, by_frame = HANDS[cycle % len(HANDS)], cycle % 2 == 1
        stamp = self.world.stamp(AHEAD)
        if phase == 10:
            target = dict(frame='gripper', keep_offset=True) if by_frame else dict(
                target=in_map(hand[0] + 0.15, hand[1] + 0.1, 1.9))
            self.held.append([a.id for a in self.send(
                'forest', 'grab', Grab, nearest=True, point=in_map(*hand, 1.8), stamp=stamp, **target)])
        elif phase == 30 and not by_frame:
            self.send('forest', 'move_grab', MoveGrab, id=self.held[-1], stamp=stamp,
                      target=in_map(hand[0] - 0.15, hand[1] + 0.2, 1.9))
        elif phase == 45:
            found = self.send('forest', 'find_branch', FindBranch, point=in_map(-hand[0], hand[1], 1.5))
            if found[0].tree != found[1].tree:
                raise AssertionError('find_branch: %s' % found)
            force = Vector3Stamped(header=Header(frame_id='map'), vector=Vector3(40.0, 20.0, 0.0))
            self.send('forest', 'apply_force', ApplyForce, tree=found[0].tree, branch=found[0].branch,
                      along=found[0].along, force=force, duration=0.3, stamp=stamp)
        elif phase == 60:
            self.send('forest', 'release', Release, id=self.held[-1], stamp=stamp)
        elif phase == 70 and cycle < TREES:
            self.send('forest', 'cut_branch', CutBranch, tree=cycle, branch=5, stamp=stamp)
        elif phase == 20:
            self.send('grass', 'tread', Tread, header=Header(stamp=stamp, frame_id='map'),
                      points=[Point(-10.0, hand[0], 0.0), Point(10.0, hand[1], 0.0), Point(hand[0], -10.0, 0.0)])
        elif phase == 50:
            swath = [Point(x, y, 0.0) for x, y in ((-8.0, 3.0), (8.0, 3.0), (0.0, 10.0))]
            cut = GrassCut(outline=[Point(-6.0, -2.0, 0.0), Point(6.0, 2.0 + 0.01 * age, 0.0)], radius=1.0,
                           height=0.12, swath=swath)
            self.send('grass', 'cut', CutGrass, header=Header(stamp=stamp, frame_id='map'), cut=cut)
