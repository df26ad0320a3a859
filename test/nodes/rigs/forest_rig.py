# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of forest_animator: a clock that advances tick by tick, logs of topics,
nodes."""
import copy
import io
import signal
import subprocess

import roslib.packages
import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import ForestEvent, ForestLayout, ForestState, SensorInterest, Viewer, WindField
from vegetation_sim.srv import GetTree, Pick, SetTf

from waiting import DEADLINE, wait_for
from watched_node import Log, WatchedNode, publisher, slave

RATE = 30  # rate of ticks [Hz]


def time_of(tick, rate=RATE):
    """Returns the first nanosecond of a tick."""
    return rospy.Time(*divmod(-(-tick * 10 ** 9 // rate), 10 ** 9))


def content_of(state):
    """Returns the bytes of a state without what depends on who subscribed when: the number of the
    message and whether it is a key frame."""
    content = copy.copy(state)
    content.header, content.sequence = Header(stamp=state.header.stamp), 0
    content.key_frame = False
    out = io.BytesIO()
    content.serialize(out)
    return out.getvalue()


class Animator(WatchedNode):
    """Client of one forest_animator."""

    LOGS = 'layout', 'state', 'view', 'events'

    def __init__(self, name='/forest_animator', namespace='/'):
        self.layout = Log(namespace + 'forest/layout', ForestLayout)
        self.state = Log(namespace + 'forest/state', ForestState)
        self.view = Log(namespace + 'forest/view', ForestState)
        self.events = Log(namespace + 'forest/events', ForestEvent)
        super().__init__(name, 'forest', name + '/get_tree', GetTree)
        self.pick = rospy.ServiceProxy(name + '/pick', Pick)
        self._set_tf = rospy.ServiceProxy(name + '/set_tf', SetTf)

    def tree(self, tree, stamp=rospy.Time()):
        answer = self._probe(tree=tree, stamp=stamp)
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def refusal(self, **request):
        """Returns the error of the service get_tree, or '' on success."""
        answer = self._probe(**request)
        return '' if answer.success else answer.message

    def set_tf(self, tree, branches, enable):
        """Starts or stops frames of branches, or of all of them if `branches` is 'all'."""
        chosen = dict(all=True) if branches == 'all' else dict(branches=branches)
        return self._set_tf(tree=tree, enable=enable, **chosen)

    def level(self, tree):
        return self.tree(tree).level

    def view_level(self, tree):
        return self.tree(tree).view_level

    def hashes(self):
        """Returns the hashes of the state by stamp."""
        return {m.header.stamp: m.hash for m in self.state.messages}

    def states(self, first=0):
        """Returns the hashes and what sensors perceive by stamp, from message `first` on."""
        return {m.header.stamp: content_of(m) for m in self.state.messages[first:]}


class TickClock:
    """Publishes the clock of a test, always half a tick after a tick.

    At that time every node has reached the tick and none has reached the next one, so messages
    published now take effect at the next tick.
    """

    def __init__(self, tick, rate=RATE):
        self.tick = tick
        self.rate = rate
        self._publisher = publisher('/clock', Clock)

    def show(self, tick):
        """Publishes the time of a tick without waiting."""
        self.tick = tick
        self.show_time(time_of(tick, self.rate) + rospy.Duration.from_sec(0.5 / self.rate))

    def show_time(self, stamp):
        self._publisher.publish(Clock(clock=stamp))

    def run(self, ticks, *animators):
        """Advances tick by tick and waits each time until every animator has sent its state. The
        same time is published again for a node whose subscription was not complete."""
        for _ in range(ticks):
            self.show(self.tick + 1)
            for animator in animators:
                animator.state.wait_for_stamp(time_of(self.tick, self.rate),
                                              lambda: self.show(self.tick))
        for animator in animators:
            animator.wait_for_services()

    def run_until(self, condition, what, *animators):
        for _ in range(100 * self.rate):
            if condition():
                return
            self.run(1, *animators)
        raise AssertionError('100 s passed without ' + what)

    def begin(self, *animators):
        """Starts time and advances until every animator uses the published wind."""
        wind = Log('/wind', WindField)
        for animator in animators:
            animator.wait_until_up('/wind')
        rospy.wait_for_service('/wind_broadcaster/tf2_frames', DEADLINE)
        # After this call the broadcaster has started completely.
        rospy.ServiceProxy('/wind_broadcaster/tf2_frames', FrameGraph)()
        wait_for(wind.connected, 'the wind')
        self.run(1, *animators)
        wind.wait(len, 'a wind', lambda: self.show(self.tick))
        for animator in animators:
            self.run_until(
                lambda: animator.state.messages[-1].wind_hash == wind.messages[-1].hash,
                'the wind of the air', *animators)
        wind.close()


class Listener:
    """Publishes a message with a place, for which animators choose levels of detail."""

    def __init__(self, message, position, topic, readers):
        self.message, self._position = message, position
        self.message.header.frame_id = 'map'
        self._publisher = publisher(topic, type(message))
        wait_for(lambda: self._publisher.get_num_connections() >= readers, 'readers of ' + topic)

    def move_to(self, x, y, z, *animators):
        """Publishes the message with this place. Returns when the animators have received it."""
        self._position.x, self._position.y, self._position.z = x, y, z
        self.send(self.message, *animators)

    def send(self, message, *animators):
        self._publisher.publish(message)
        for animator in animators:
            animator.settle()

    def close(self):
        self._publisher.unregister()


class ViewerClient(Listener):
    """A viewer that faces east."""

    def __init__(self, name='eye', topic='/viewer', readers=1):
        message = Viewer(id=name, field_of_view=0.8, height=900)
        message.pose.orientation.w = 1.0
        super().__init__(message, message.pose.position, topic, readers)


class SensorClient(Listener):
    """A sensor that requires fine levels of detail around it."""

    def __init__(self, name='lidar', topic='/forest/sensors', readers=1):
        message = SensorInterest(id=name, range=25.0, tolerance=0.01)
        super().__init__(message, message.position, topic, readers)


def memory_of(node):
    """Returns the resident memory of the process of a node [bytes]."""
    _, _, process = slave(node).getPid('/forest_rig')
    with open('/proc/%d/status' % process) as status:
        line = next(line for line in status if line.startswith('VmRSS:'))
    return 1024 * int(line.split()[1])


def start_animator(name, remappings, **parameters):
    """Starts a forest_animator; the test must stop it."""
    return start_node('forest_animator', name, remappings, **parameters)


def start_node(program, name, remappings, **parameters):
    """Starts a node of the package; the test must stop it."""
    rospy.set_param(name, parameters)
    executable = roslib.packages.find_node('vegetation_sim', program)[0]
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
