# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the clients of all nodes share."""
import rospy
from geometry_msgs.msg import Point, PointStamped, Vector3
from std_msgs.msg import Header


class VegetationError(RuntimeError):
    """A node rejected a request, with the node's message, or did not answer. `code` is a constant
    of vegetation_sim.msg.ErrorCode, or None if no node has answered."""

    def __init__(self, text, code=None):
        super().__init__(text)
        self.code = code


class Client:
    """Calls the services of one node."""

    def __init__(self, node, timeout):
        """`timeout` [s] of wall time limits the wait for each service. A node advertises its
        services once the clock has begun."""
        self.node = rospy.resolve_name(node)
        self.timeout = timeout
        self._proxies = {}

    def call(self, name, service, /, **request):
        """Returns the response to a request. Raises VegetationError if it is rejected."""
        if name not in self._proxies:
            self._proxies[name] = self._connect('%s/%s' % (self.node, name), service)
        try:
            response = self._proxies[name](**request)
        except rospy.ServiceException as error:
            raise VegetationError('%s/%s: %s' % (self.node, name, error)) from error
        if not response.success:
            raise VegetationError('%s/%s: %s' % (self.node, name, response.message),
                                  getattr(response, 'error_code', None))
        return response

    def _connect(self, name, service):
        try:
            rospy.wait_for_service(name, self.timeout)
        except rospy.ROSException as error:
            raise VegetationError('no service %s within %g s; does the node run, and the clock?' % (
                name, self.timeout)) from error
        return rospy.ServiceProxy(name, service)

    def topic(self, name):
        """Returns the name of a topic beside the node."""
        return rospy.names.ns_join(rospy.names.namespace(self.node), name)


def given(**numbers):
    """Returns the numbers that are not None, with their flags, as arguments of a message."""
    found = {name: number for name, number in numbers.items() if number is not None}
    return dict(found, **{'has_' + name: True for name in found})


def point(place):
    """Returns a geometry_msgs/Point of three numbers, or of two on the ground."""
    return Point(*map(float, tuple(place) + (0.0,) * (3 - len(place))))


def stamped(place, frame='', stamp=None):
    return PointStamped(header(frame, stamp), point(place))


def header(frame='', stamp=None):
    return Header(frame_id=frame, stamp=stamp or rospy.Time())


def vector(values):
    return Vector3(*map(float, values))


def numbers(message):
    """Returns the components of a Point or Vector3."""
    return (message.x, message.y, message.z)
