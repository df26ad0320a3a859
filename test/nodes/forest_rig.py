# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of forest_animator share: a clock that goes tick by tick, logs of topics, nodes."""
import signal
import subprocess
import threading
import warnings
import xmlrpc.client

import roslib.packages
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Clock
from vegetation_sim.msg import ForestEvent, ForestLayout, ForestState, Viewer, WindField
from vegetation_sim.srv import GetTree, GetWindField, Pick, SetTf

from waiting import DEADLINE, wait_for

RATE = 30  # ticks [Hz]
REMINDER = 0.5  # [s] of wall time
# Publishers without a queue: a message is in the reader's socket before publish() returns.
warnings.simplefilter('ignore', SyntaxWarning)


def time_of(tick, rate=RATE):
    """First nanosecond of a tick."""
    return rospy.Time(*divmod(-(-tick * 10 ** 9 // rate), 10 ** 9))


def publisher(topic, message_type):
    return rospy.Publisher(topic, message_type, queue_size=None, tcp_nodelay=True)


class Log:
    """All that a topic said."""

    def __init__(self, topic, message_type):
        self.topic = topic
        self.messages = []
        self._heard = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, message_type, self._hear, tcp_nodelay=True)

    def _hear(self, message):
        with self._heard:
            self.messages.append(message)
            self._heard.notify_all()

    def wait(self, condition, what, remind=lambda: None):
        """Waits until `condition(messages)` is true, and reminds now and then; returns its value."""
        for _ in range(int(DEADLINE / REMINDER)):
            with self._heard:
                value = self._heard.wait_for(lambda: condition(self.messages), REMINDER)
            if value:
                return value
            remind()
        raise AssertionError('waited in vain for %s on %s' % (what, self.topic))

    def wait_for_stamp(self, stamp, remind=lambda: None):
        """The newest message, once it has this stamp."""
        return self.wait(lambda all: all and all[-1].header.stamp == stamp and all[-1],
                         str(stamp), remind)

    def connected(self):
        return self._subscriber.get_num_connections() > 0

    def close(self):
        self._subscriber.unregister()


class Animator:
    """One forest_animator as its users see it."""

    def __init__(self, name='/forest_animator', namespace='/'):
        self.name = name
        self.layout = Log(namespace + 'forest/layout', ForestLayout)
        self.state = Log(namespace + 'forest/state', ForestState)
        self.events = Log(namespace + 'forest/events', ForestEvent)
        self.process = name  # node that it lives in: a manager's, of a nodelet
        self.reconnect()
        self.pick = rospy.ServiceProxy(name + '/pick', Pick)
        self.set_tf = rospy.ServiceProxy(name + '/set_tf', SetTf)

    def reconnect(self):
        self._tree = rospy.ServiceProxy(self.name + '/get_tree', GetTree, persistent=True)

    def wait_until_up(self, *topics):
        """Until it listens to the clock and `topics`, and its first state will be heard here."""
        self._tree.wait_for_service(DEADLINE)
        self.settle()
        for topic in ('/clock',) + topics:
            wait_for(lambda: listens(self.process, topic), '%s to hear %s' % (self.name, topic))
        for log in (self.layout, self.state, self.events):
            wait_for(log.connected, log.topic)

    def settle(self):
        """Returns when it has taken all that was published before: it reads its sockets in turns,
        so what lay in another socket at the first call is in its queue by the second."""
        for _ in range(2):
            self._tree(tree=2 ** 32 - 1)

    def tree(self, tree, stamp=rospy.Time()):
        answer = self._tree(tree=tree, stamp=stamp)
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def refusal(self, **request):
        """Message with which get_tree refuses."""
        answer = self._tree(**request)
        return '' if answer.success else answer.message

    def level(self, tree):
        return self.tree(tree).level

    def hashes(self):
        """Hash of the state by stamp."""
        return {m.header.stamp: m.hash for m in self.state.messages}

    def diagnostics(self):
        """The node's next diagnostics, by key."""
        log = Log('/diagnostics', DiagnosticArray)
        name = self.name.lstrip('/') + ': forest'
        log.wait(lambda all: any(s.name == name for m in all for s in m.status), name)
        log.close()
        status = [s for m in log.messages for s in m.status if s.name == name][-1]
        return {pair.key: float(pair.value) for pair in status.values}

    def close(self):
        for log in (self.layout, self.state, self.events):
            log.close()
        self._tree.close()


class TickClock:
    """The clock of a test. It stands half a tick after a tick: every node has come to that tick
    and none to the next, so that what is published now takes effect at the next one."""

    def __init__(self, tick, rate=RATE):
        self.tick = tick
        self.rate = rate
        self._publisher = publisher('/clock', Clock)

    def show(self, tick):
        """Shows the time of a tick without waiting for anything."""
        self.tick = tick
        self.show_time(time_of(tick, self.rate) + rospy.Duration.from_sec(0.5 / self.rate))

    def show_time(self, stamp):
        self._publisher.publish(Clock(clock=stamp))

    def run(self, ticks, *animators):
        """Goes on tick by tick, each only after every animator has sent its state. Who was only
        just about to listen gets the same time again."""
        for _ in range(ticks):
            self.show(self.tick + 1)
            for animator in animators:
                animator.state.wait_for_stamp(time_of(self.tick, self.rate),
                                              lambda: self.show(self.tick))

    def run_until(self, condition, what, *animators):
        for _ in range(100 * self.rate):
            if condition():
                return
            self.run(1, *animators)
        raise AssertionError('100 s passed without ' + what)

    def begin(self, *animators):
        """Starts time, and goes on until every animator moves by the wind that is on the air."""
        wind = Log('/wind', WindField)
        for animator in animators:
            animator.wait_until_up('/wind')
        rospy.wait_for_service('/wind_broadcaster/get_field', DEADLINE)
        rospy.ServiceProxy('/wind_broadcaster/get_field', GetWindField)()  # so it is up entirely
        wait_for(wind.connected, 'the wind')
        self.run(1, *animators)
        wind.wait(len, 'a wind', lambda: self.show(self.tick))
        for animator in animators:
            self.run_until(
                lambda: animator.state.messages[-1].wind_hash == wind.messages[-1].hash,
                'the wind of the air', *animators)
        wind.close()


class Eye:
    """A viewer that looks east from where it is put."""

    def __init__(self, name='eye', topic='/viewer', readers=1):
        self.message = Viewer(id=name, field_of_view=0.8, height=900)
        self.message.header.frame_id = 'map'
        self.message.pose.orientation.w = 1.0
        self._publisher = publisher(topic, Viewer)
        wait_for(lambda: self._publisher.get_num_connections() >= readers, 'readers of ' + topic)

    def look(self, x, y, z, *animators):
        """Returns when the animators have heard it."""
        position = self.message.pose.position
        position.x, position.y, position.z = x, y, z
        self.send(self.message, *animators)

    def send(self, message, *animators):
        self._publisher.publish(message)
        for animator in animators:
            animator.settle()

    def close(self):
        self._publisher.unregister()


def slave(node):
    """The node's own XML-RPC interface."""
    return xmlrpc.client.ServerProxy(rosgraph.Master('/forest_rig').lookupNode(node))


def listens(node, topic):
    try:
        _, _, links = slave(node).getBusInfo('/forest_rig')
    except (rosgraph.MasterException, OSError):
        return False
    return any(link[2] == 'i' and link[4] == topic for link in links)


def memory_of(node):
    """Resident memory of a node's process [byte]."""
    _, _, process = slave(node).getPid('/forest_rig')
    with open('/proc/%d/status' % process) as status:
        line = next(line for line in status if line.startswith('VmRSS:'))
    return 1024 * int(line.split()[1])


def start_animator(name, remappings, **parameters):
    """Starts a forest_animator that the test ends itself."""
    rospy.set_param(name, parameters)
    executable = roslib.packages.find_node('vegetation_sim', 'forest_animator')[0]
    namespace, _, node = name.rpartition('/')
    return subprocess.Popen([executable, '__name:=' + node, '__ns:=' + (namespace or '/')] +
                            ['%s:=%s' % pair for pair in remappings.items()])


def stop(process, how=signal.SIGINT):
    process.send_signal(how)
    return process.wait(DEADLINE)


def scene(name):
    folder = roslib.packages.get_pkg_dir('vegetation_sim')
    return folder + ('/config/scenarios/' if name == 'forest' else '/test/nodes/scenarios/') + \
        name + '.yaml'
