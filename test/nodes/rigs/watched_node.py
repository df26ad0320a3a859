# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for all nodes with a clock: logs of topics, connections, and a node through its ROS
interface."""
import fcntl
import struct
import threading
import warnings
import xmlrpc.client

import rosgraph
import rospy
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import PredictedErrors

from waiting import DEADLINE, wait_for

REMINDER = 0.5  # [s] of wall time between two reminders
# Publishers have no queue, so a message is in a socket before publish() returns.
warnings.simplefilter('ignore', SyntaxWarning)


SIOCOUTQNSD = 0x894B  # ioctl that returns the bytes of a socket that were not sent yet, tcp(7)

publishers = []


def publisher(topic, message_type):
    publishers.append(rospy.Publisher(topic, message_type, queue_size=None, tcp_nodelay=True))
    return publishers[-1]


def unsent(socket):
    """Returns the number of bytes that a socket has not sent; 0 if its reader has gone, which another
    thread may see at any time."""
    try:
        return struct.unpack('i', fcntl.ioctl(socket, SIOCOUTQNSD, b'\0' * 4))[0]
    except (OSError, ValueError):
        return 0


def all_delivered():
    """Returns whether the last byte of all published messages is in the socket of its
    subscriber."""
    links = [link for publisher in publishers if publisher.impl for link in list(publisher.impl.connections)]
    return not any(unsent(link.socket) for link in links if link.socket)


def slave(node):
    """Returns the XML-RPC interface of a node."""
    return xmlrpc.client.ServerProxy(rosgraph.Master('/watched_node').lookupNode(node))


def links(address, direction, topic):
    """Returns the other ends of a node's connections for a topic; direction is 'i' (in) or 'o'
    (out)."""
    _, _, all_links = xmlrpc.client.ServerProxy(address).getBusInfo('/watched_node')
    return [link[1] for link in all_links if link[2] == direction and link[4] == topic]


def listens(node, topic):
    """Returns whether the node receives all messages from now on: both ends have the connection."""
    try:
        address = rosgraph.Master('/watched_node').lookupNode(node)
        sources = links(address, 'i', topic)
        return bool(sources) and all(node in links(source, 'o', topic) for source in sources)
    except (rosgraph.MasterException, OSError):
        return False


def wait_for_readers(topic, *nodes):
    """Waits until these nodes receive all messages that this test publishes."""
    own = rosgraph.Master('/watched_node').lookupNode(rospy.get_name())
    wait_for(lambda: set(nodes) <= set(links(own, 'o', topic)),
             '%s to subscribe to %s' % (nodes, topic))


class Log:
    """Keeps all messages of a topic."""

    def __init__(self, topic, message_type):
        self.topic = topic
        self.messages = []
        self._received = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, message_type, self._on_message, tcp_nodelay=True)

    def _on_message(self, message):
        with self._received:
            self.messages.append(message)
            self._received.notify_all()

    def wait(self, condition, what, remind=lambda: None):
        """Waits until `condition(messages)` is true, calls `remind` repeatedly, and returns the
        value."""
        for _ in range(int(DEADLINE / REMINDER)):
            with self._received:
                value = self._received.wait_for(lambda: condition(self.messages), REMINDER)
            if value:
                return value
            remind()
        raise AssertionError('timed out waiting for %s on %s' % (what, self.topic))

    def wait_for_stamp(self, stamp, remind=lambda: None):
        """Returns the newest message as soon as it has this stamp."""
        return self.wait(lambda all: all and all[-1].header.stamp == stamp and all[-1],
                         str(stamp), remind)

    def connected(self):
        return (self._subscriber.get_num_connections() > 0 and
                listens(rospy.get_name(), self._subscriber.resolved_name))

    def close(self):
        self._subscriber.unregister()


def number_or_text(value):
    try:
        return float(value)
    except ValueError:
        return value


def serves(service):
    """Returns whether a node advertises the service: time has begun for it."""
    try:
        rospy.wait_for_service(service, timeout=0.01)
        return True
    except rospy.ROSException:
        return False


class WatchedNode:
    """A node through its ROS interface. Its service `probe` has no effect when it is called without
    arguments. Until time has begun for the node, its process answers only ~tf2_frames."""

    LOGS = 'layout', 'state', 'events'  # names of the attributes

    def __init__(self, name, status, probe, probe_type):
        self.name = name
        self.process = name  # the name of the process: for a nodelet that of its manager
        self._status = name.lstrip('/') + ': ' + status
        self._probe_name = probe
        self._reconnect = lambda: rospy.ServiceProxy(probe, probe_type, persistent=True)
        self.reconnect()

    def reconnect(self):
        """Connects to a node that was restarted."""
        self._probe = self._reconnect()
        self._begun = False

    def logs(self):
        return [getattr(self, name) for name in self.LOGS]

    def expect_replay(self):
        """Waits for no events from now on: a replay publishes none."""
        self.LOGS = [name for name in self.LOGS if name != 'events']

    def wait_until_up(self, *topics):
        """Waits until the node subscribes to the clock and `topics`, and this test receives its
        first state."""
        rospy.wait_for_service(self.process + '/tf2_frames', DEADLINE)
        self.settle()
        for topic in ('/clock',) + topics:
            wait_for(lambda: listens(self.process, topic),
                     '%s to subscribe to %s' % (self.name, topic))
        for log in self.logs():
            wait_for(log.connected, log.topic)
        self.settle()  # The node has then received latched messages.

    def wait_for_services(self):
        """Waits until the node, whose first tick has come, offers its services."""
        if not self._begun:
            wait_for(lambda: serves(self._probe_name), self._probe_name)
            self._begun = True

    def settle(self):
        """Returns when the node has received all messages that were published before. A node reads
        its sockets in turn, so a message that is in another socket at the first call is in the
        queue by the second."""
        wait_for(all_delivered, 'all that was published to be in the sockets of its readers')
        self._begun = self._begun or serves(self._probe_name)
        early = rospy.ServiceProxy(self.process + '/tf2_frames', FrameGraph)
        for _ in range(2):
            self._probe() if self._begun else early()

    def has_transform(self, frame, stamp):
        """Returns whether the newest transform of a frame in the node's tf buffer has this stamp,
        to 2 ms."""
        frames = rospy.ServiceProxy(self.process + '/tf2_frames', FrameGraph)().frame_yaml
        newest = (yaml.safe_load(frames) or {}).get(frame, {}).get('most_recent_transform', 0.0)
        return abs(newest - stamp.to_sec()) < 2e-3

    def settle_frames(self, transforms):
        """Returns when the node, a thread of which reads tf, has these transforms and all messages."""
        for t in transforms:
            wait_for(lambda t=t: self.has_transform(t.child_frame_id, t.header.stamp), t.child_frame_id)
        self.settle()

    def diagnostics(self, part=None):
        """Returns the node's next diagnostics by key, of the node itself or of its part `part`."""
        return {pair.key: number_or_text(pair.value) for pair in self.status(part).values}

    def status(self, part=None):
        """Returns the next DiagnosticStatus of the node itself or of its part `part`."""
        name = self.name.lstrip('/') + ': ' + part if part else self._status
        log = Log('/diagnostics', DiagnosticArray)
        log.wait(lambda all: any(s.name == name for m in all for s in m.status), name)
        log.close()
        return [s for m in log.messages for s in m.status if s.name == name][-1]

    @staticmethod
    def predicted_errors(topic):
        """Returns the next predicted errors of a node by the topics that it sends (N9)."""
        log = Log(topic, PredictedErrors)
        log.wait(len, 'predicted errors')
        log.close()
        return {error.topic: error for error in log.messages[-1].errors}

    def close(self):
        for log in self.logs():
            log.close()
        self._probe.close()
