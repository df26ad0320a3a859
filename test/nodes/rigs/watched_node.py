# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the rigs of all nodes with a clock share: logs of topics, links, the node as users see it."""
import fcntl
import struct
import threading
import warnings
import xmlrpc.client

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray

from waiting import DEADLINE, wait_for

REMINDER = 0.5  # [s] of wall time
# Publishers without a queue: a message is in a socket before publish() returns.
warnings.simplefilter('ignore', SyntaxWarning)


SIOCOUTQNSD = 0x894B  # how much of a socket the other end had no room for yet, tcp(7)

publishers = []


def publisher(topic, message_type):
    publishers.append(rospy.Publisher(topic, message_type, queue_size=None, tcp_nodelay=True))
    return publishers[-1]


def all_delivered():
    """Whether the last byte of all that was published lies in its reader's socket."""
    sockets = [link.socket for publisher in publishers if publisher.impl
               for link in publisher.impl.connections
               if link.socket and link.socket.fileno() >= 0]
    return not any(struct.unpack('i', fcntl.ioctl(socket, SIOCOUTQNSD, b'\0' * 4))[0]
                   for socket in sockets)


def slave(node):
    """The node's own XML-RPC interface."""
    return xmlrpc.client.ServerProxy(rosgraph.Master('/watched_node').lookupNode(node))


def links(address, direction, topic):
    """Other ends of a node's links of a topic, 'i'n or 'o'ut."""
    _, _, all_links = xmlrpc.client.ServerProxy(address).getBusInfo('/watched_node')
    return [link[1] for link in all_links if link[2] == direction and link[4] == topic]


def listens(node, topic):
    """Whether all that is published from now on will be heard: both ends hold the link."""
    try:
        address = rosgraph.Master('/watched_node').lookupNode(node)
        sources = links(address, 'i', topic)
        return bool(sources) and all(node in links(source, 'o', topic) for source in sources)
    except (rosgraph.MasterException, OSError):
        return False


def wait_for_readers(topic, *nodes):
    """Until all that this test publishes will be heard by these nodes."""
    own = rosgraph.Master('/watched_node').lookupNode(rospy.get_name())
    wait_for(lambda: set(nodes) <= set(links(own, 'o', topic)), '%s to hear %s' % (nodes, topic))


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
        return (self._subscriber.get_num_connections() > 0 and
                listens(rospy.get_name(), self._subscriber.resolved_name))

    def close(self):
        self._subscriber.unregister()


def number_or_text(value):
    try:
        return float(value)
    except ValueError:
        return value


class WatchedNode:
    """A node as its users see it. It has a service `probe` that changes nothing when it is called
    without arguments."""

    LOGS = 'layout', 'state', 'events'  # attributes

    def __init__(self, name, status, probe, probe_type):
        self.name = name
        self.process = name  # node that it lives in: a manager's, of a nodelet
        self._status = name.lstrip('/') + ': ' + status
        self._reconnect = lambda: rospy.ServiceProxy(probe, probe_type, persistent=True)
        self.reconnect()

    def reconnect(self):
        """To a node that was started anew."""
        self._probe = self._reconnect()

    def logs(self):
        return [getattr(self, name) for name in self.LOGS]

    def wait_until_up(self, *topics):
        """Until it listens to the clock and `topics`, and its first state will be heard here."""
        self._probe.wait_for_service(DEADLINE)
        self.settle()
        for topic in ('/clock',) + topics:
            wait_for(lambda: listens(self.process, topic), '%s to hear %s' % (self.name, topic))
        for log in self.logs():
            wait_for(log.connected, log.topic)
        self.settle()  # so it has what was latched

    def settle(self):
        """Returns when it has taken all that was published before: it reads its sockets in turns,
        so what lay in another socket at the first call is in its queue by the second."""
        wait_for(all_delivered, 'all that was published to be in the sockets of its readers')
        for _ in range(2):
            self._probe()

    def diagnostics(self, part=None):
        """The node's next diagnostics, by key; of another part than its own."""
        name = self.name.lstrip('/') + ': ' + part if part else self._status
        log = Log('/diagnostics', DiagnosticArray)
        log.wait(lambda all: any(s.name == name for m in all for s in m.status), name)
        log.close()
        status = [s for m in log.messages for s in m.status if s.name == name][-1]
        return {pair.key: number_or_text(pair.value) for pair in status.values}

    def close(self):
        for log in self.logs():
            log.close()
        self._probe.close()
