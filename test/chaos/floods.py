# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Floods of every topic that the nodes read and of every service that they offer."""
import threading

import rospy
import rosservice
import rostopic

from bad_messages import DEFECTS, make_bad
from scene import NODES
from visitors import SETTINGS
from watched_node import publisher

# /clock and the frames are published by the test. rosout and the loggers belong to roscpp.
NOT_FLOODED = '/clock', '/tf', '/tf_static'
OF_ROSCPP = 'get_loggers', 'set_logger_level'
MESSAGES, REQUESTS = 300, 40  # of a flood
LARGE = 3                     # of them huge ones
CONNECTION = 0.5              # [s] of wall time


def _pairs(index):
    """Yields name and node of subscribers (1) or services (2)."""
    for name, users in rospy.get_master().getSystemState()[2][index]:
        for user in users:
            if user.lstrip('/') in NODES:
                yield name, user.lstrip('/')


def find_topics():
    """Returns the nodes of the package that read each topic."""
    readers = {}
    for topic, node in _pairs(1):
        if topic not in NOT_FLOODED:
            readers.setdefault(topic, set()).add(node)
    return {topic: sorted(nodes) for topic, nodes in sorted(readers.items())}


def find_services():
    """Returns the services whose requests can be bad, with their nodes."""
    out = []
    for service, node in sorted(_pairs(2)):
        if service.rpartition('/')[2] in OF_ROSCPP:
            continue
        kind = rosservice.get_service_class_by_name(service)
        if set(kind._request_class._slot_types) - {'bool'}:
            out.append((service, node))
    return out


def _defects(random, count):
    """Returns a random sequence with each defect at least once."""
    out = [random.choice(DEFECTS[:-1]) for _ in range(count)] + list(DEFECTS) + ['huge'] * LARGE
    random.shuffle(out)
    return out


def flood_topic(topic, random):
    """Publishes bad messages as fast as possible."""
    message_class = rostopic.get_topic_class(topic)[0]
    flood = publisher(topic, message_class)
    threading.Event().wait(CONNECTION)
    made = {defect: make_bad(message_class, defect) for defect in DEFECTS}
    for defect in _defects(random, MESSAGES):
        flood.publish(made[defect])
    return flood


def _bad_request(service, kind, defect):
    """A setting must have the name of a parameter, or the server ignores it."""
    request = make_bad(kind._request_class, defect)
    if service.endswith('/set_parameters') and defect == 'not finite':
        names = {'/%s/set_parameters' % node: name for node, name, _, _ in SETTINGS}
        request.config.doubles[0].name = names[service]
    return request


def flood_service(service, random):
    """Calls a service with bad requests. Returns the number of calls, of refusals and of calls
    without an answer."""
    kind = rosservice.get_service_class_by_name(service)
    proxy, refused, failed = rospy.ServiceProxy(service, kind, persistent=True), 0, 0
    defects = _defects(random, REQUESTS)
    for defect in defects:
        try:
            answer = proxy(_bad_request(service, kind, defect))
            refused += not getattr(answer, 'success', True)
        except (rospy.ServiceException, rospy.ROSException):
            failed += 1
            proxy = rospy.ServiceProxy(service, kind, persistent=True)
    proxy.close()
    return len(defects), refused, failed
