# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What every node's test of snapshots and checkpoints does: states continue alike in a fresh
process, bad files change nothing, and a node that is killed continues from its checkpoint."""
import os
import shutil
import signal
import struct
import tempfile
import unittest
from random import Random

import rospy
from geometry_msgs.msg import Vector3
from vegetation_sim.msg import WindField, WindPrimitive
from vegetation_sim.srv import LoadSnapshot, SaveSnapshot, SetWindPrimitive

from forest_rig import TickClock, scene, start_node, stop
from waiting import wait_for
from watched_node import Log, publisher

START = 1000 * 30
SAVED = 60    # ticks before the state is saved
LATER = 600   # ticks after it
EVERY = 60    # ticks between two looks at the hash
LAST = 120    # ticks of a run with kills
KILLS = 5     # of one such run


class RunningNode:
    """A process of a node of the package in a namespace of its own, and its client."""

    def __init__(self, case, namespace, client=True, remappings=None, **parameters):
        self.namespace = '/%s/' % namespace
        self.name = self.namespace + case.PROGRAM
        self._program, self._remappings = case.PROGRAM, remappings or {}
        self._parameters = dict(dict(scenario=scene(case.SCENE), snapshot_folder=case.folder),
                                **parameters)
        self.client = case.make_client(self.name, self.namespace) if client else None
        self._save = rospy.ServiceProxy(self.name + '/save_snapshot', SaveSnapshot)
        self._load = rospy.ServiceProxy(self.name + '/load_snapshot', LoadSnapshot)
        self.start()

    def start(self):
        self.process = start_node(self._program, self.name, self._remappings, **self._parameters)

    def stop(self):
        if self.process.poll() is None:
            stop(self.process)
        if self.client:
            self.client.close()

    def kill(self):
        """Ends the process at once, and starts it again."""
        stop(self.process, signal.SIGKILL)
        self.start()
        if self.client:
            self.client.reconnect()

    def save(self, name):
        answer = self._save(name=name)
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def load(self, name, **request):
        answer = self._load(name=name, **request)
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def refusal(self, name, **request):
        """Returns the error of the service load_snapshot, or '' on success."""
        answer = self._load(name=name, **request)
        return '' if answer.success else answer.message

    def state_hash(self):
        return self.save('probe').hash


class SnapshotCase(unittest.TestCase):
    """A test of one kind of node. Derived classes have PROGRAM, make_client() and act()."""
    PROGRAM = ''
    SCENE, OTHER_SCENE = 'garden', 'no_trees'
    TOPICS = ()             # of the inputs that act() publishes
    HASHES = LATER // EVERY  # different ones of the later ticks

    def act(self, node, tick):
        """Sends the inputs before the tick `tick` of a run."""

    def prepare(self, node):
        """Called once the node runs its first tick."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.clock = TickClock(START)
        self.nodes = []

    def tearDown(self):
        for node in self.nodes:
            node.stop()
        shutil.rmtree(self.folder)

    def start(self, namespace, tick, **parameters):
        """Starts a node whose first tick is `tick` of a run."""
        node = RunningNode(self, namespace, **parameters)
        self.nodes.append(node)
        node.client.wait_until_up()
        self.clock.tick = START + tick - 1
        self.clock.run(1, node.client)
        self.prepare(node)
        return node

    def run_to(self, node, first, last):
        """Runs the ticks after `first` until `last` of a run. Returns the hashes on the way."""
        hashes = {}
        for tick in range(first + 1, last + 1):
            self.act(node, tick)
            self.clock.run(1, node.client)
            if tick % EVERY == 0:
                hashes[tick] = node.state_hash()
        return hashes

    def finish(self, node, tick):
        """Waits until a node that has the inputs of a tick has run it. It may have done so before it
        was killed, and then it does not publish the state again."""
        def is_done():
            self.clock.show(START + tick)
            try:
                return node.save('probe').stamp == self.stamp_of(tick)
            except rospy.ServiceException:  # the node starts
                return False
        wait_for(is_done, 'tick %d' % tick)
        return {tick: node.state_hash()} if tick % EVERY == 0 else {}

    def file_of(self, name, node):
        return os.path.join(self.folder, name, node.name[1:].replace('/', '.') + '.snapshot')

    def test_a_saved_state_continues_alike_in_a_fresh_process(self):
        first = self.start('first', 0)
        self.run_to(first, 0, SAVED)
        saved = first.save('kept')
        self.assertEqual(saved.file, self.file_of('kept', first))
        self.assertEqual(saved.bytes, os.path.getsize(saved.file))
        self.assertEqual(saved.stamp, self.stamp_of(SAVED))
        expected = self.run_to(first, SAVED, SAVED + LATER)
        self.assertEqual(len(set(expected.values())), self.HASHES)
        first.stop()
        second = self.start('second', SAVED)
        fresh = second.state_hash()
        self.assertNotEqual(fresh, saved.hash)
        self.check_refusals(second, first, saved)
        self.assertEqual(second.state_hash(), fresh, 'a rejected file changes nothing')
        checked = second.load('kept', node=first.name, check_only=True)
        self.assertEqual((checked.hash, second.state_hash()), (saved.hash, fresh))
        loaded = second.load('kept', node=first.name)
        self.assertEqual((loaded.hash, loaded.shift, loaded.stamp), (saved.hash, 0.0, saved.stamp))
        self.assertEqual(second.state_hash(), saved.hash)
        self.assertEqual(self.run_to(second, SAVED, SAVED + LATER), expected)

    def stamp_of(self, tick):
        at = -(-(START + tick) * 10 ** 9 // 30)
        return rospy.Time(at // 10 ** 9, at % 10 ** 9)

    def check_refusals(self, node, writer, saved):
        with open(saved.file, 'rb') as file:
            good = file.read()
        version = good.index(b'\n') + 1
        bad = {
            'truncated': (good[:len(good) // 2], 'truncated or altered'),
            'altered': (good[:-100] + bytes([good[-100] ^ 1]) + good[-99:], 'truncated or altered'),
            'versioned': (good[:version] + struct.pack('<I', 99) + good[version + 4:],
                          'version = 99'),
            'other': (b'something else', 'no snapshot'),
        }
        for name, (content, why) in bad.items():
            os.makedirs(os.path.join(self.folder, name))
            with open(self.file_of(name, writer), 'wb') as file:
                file.write(content)
            message = node.refusal(name, node=writer.name)
            self.assertIn(why, message)
            self.assertIn(name, message)
        self.assertIn('there is no such file', node.refusal('kept'))
        self.assertIn("name = '../kept'", node.refusal('../kept'))
        self.assertIn("node = ", node.refusal('kept', node='/../first'))
        other = RunningNode(self, 'other', client=False, scenario=scene(self.OTHER_SCENE))
        self.nodes.append(other)
        wait_for(lambda: self.shown_to(other), 'the other node')
        other.save('kept')
        other.stop()
        self.assertIn('scene hash', node.refusal('kept', node=other.name))

    def shown_to(self, node):
        """Shows the time until a node has begun."""
        self.clock.show(self.clock.tick)
        try:
            rospy.wait_for_service(node.name + '/save_snapshot', 0.1)
            return True
        except rospy.ROSException:
            return False

    def test_a_killed_node_continues_from_its_checkpoint(self):
        """With the environment variable CHECKPOINT_KILLS, so many times at random ticks."""
        count = int(os.environ.get('CHECKPOINT_KILLS', 0))
        episodes = [self.random_kills(i) for i in range(-(-count // KILLS))] or [
            [(37, False), (49, True), (81, True)]]
        plain = self.start('plain', 0)
        expected = self.run_to(plain, 0, LAST)
        plain.stop()
        equal = 0
        for number, kills in enumerate(episodes):
            found = self.run_with_kills('killed_%d' % number, kills)
            self.assertEqual(found, expected, kills)
            equal += len(kills)
        print('%s: equal hashes after %d kills' % (self.PROGRAM, equal))

    def random_kills(self, episode):
        """Returns ticks, and whether the node is killed within the next tick."""
        random = Random(episode)
        ticks = sorted(random.sample(range(2, LAST - 1), KILLS))
        return [(tick, random.random() < 0.5) for tick in ticks]

    def run_with_kills(self, namespace, kills):
        """Returns the hashes of a run whose node is killed after or within some ticks."""
        node = self.start(namespace, 0, checkpoint_period=0.7, checkpoint=True)
        found, tick = {}, 0
        for kill, within in kills:
            found.update(self.run_to(node, tick, kill))
            tick = kill
            if within:
                self.act(node, tick + 1)
                self.clock.show(START + tick + 1)
            node.kill()
            self.clock.tick = START + tick
            node.client.wait_until_up(*(node.namespace + topic for topic in self.TOPICS))
            if within:
                tick += 1
                found.update(self.finish(node, tick))
        found.update(self.run_to(node, tick, LAST))
        node.stop()
        return found


class WindSender:
    """Publishes winds to one node. A broadcaster computes their hashes once."""
    winds = []

    def __init__(self, case, node):
        if not self.winds:
            self.record(case)
        self._node = node
        self._publisher = publisher(node.namespace + 'wind', WindField)
        wait_for(lambda: self._publisher.get_num_connections() == 1, 'the reader of the wind')

    def send(self, number):
        self._publisher.publish(self.winds[number])
        self._node.client.settle()

    @classmethod
    def record(cls, case):
        """Takes the wind of the scene, and the same with a gust."""
        process = start_node('wind_broadcaster', '/air/wind_broadcaster', {},
                             scenario=scene(case.SCENE))
        log = Log('/air/wind', WindField)
        log.wait(len, 'a wind', lambda: case.clock.show(case.clock.tick))
        gust = WindPrimitive(name='gust', kind=WindPrimitive.DISK, velocity=Vector3(4.0, 0.0, 0.0),
                             radius=20.0, omega=3.0, fade_in=0.5)
        change = rospy.ServiceProxy('/air/wind_broadcaster/set_primitive', SetWindPrimitive)
        change.wait_for_service(30.0)
        answer = change(primitive=gust)
        if not answer.success:
            raise AssertionError(answer.message)
        log.wait(lambda all: len(all) >= 2, 'a second wind')
        cls.winds = log.messages[:2]
        log.close()
        stop(process)
