# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of grabs: a forest with one clock and clients of its services."""
import math

import rospy
from geometry_msgs.msg import Point, PointStamped, TransformStamped, WrenchStamped
from tf2_msgs.msg import TFMessage
from vegetation_sim.srv import ApplyForce, Grab, MoveGrab, Release

from forest_rig import Animator, time_of
from given import given
from waiting import wait_for
from watched_node import Log, publisher, wait_for_readers

TREE = 0
LIMB = 46  # outer third of a limb, 2.4 cm thick, 2.7 m above the ground
OTHER_LIMB = 49
STIFFNESS = 20000.0  # [N/m]; the stiffness of the limb itself is about 8000


def vector(v):
    return (v.x, v.y, v.z)


def minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def plus(a, b):
    return tuple(p + q for p, q in zip(a, b))


def along_z(pose, distance):
    p, q = pose.position, pose.orientation
    axis = (2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
            1 - 2 * (q.x * q.x + q.y * q.y))
    return tuple(a + distance * b for a, b in zip(vector(p), axis))


class Hands(Animator):
    """Client of a forest_animator and of the services that hold its branches."""

    def __init__(self, clock, name='/forest_animator'):
        super().__init__(name)
        self.clock = clock
        self.grab = rospy.ServiceProxy(name + '/grab', Grab)
        self.move_grab = rospy.ServiceProxy(name + '/move_grab', MoveGrab)
        self.release = rospy.ServiceProxy(name + '/release', Release)
        self.apply_force = rospy.ServiceProxy(name + '/apply_force', ApplyForce)
        self.wrenches = Log('/forest/wrenches', WrenchStamped)
        self._frames = publisher('/tf', TFMessage)

    def run(self, ticks):
        self.clock.run(ticks, self)

    def point(self, branch, along, tree=TREE):
        return along_z(self.tree(tree).transforms.poses[branch], along)

    def take(self, **request):
        """Grabs a branch. Returns the reply."""
        numbers = dict(lease=60.0, stiffness=STIFFNESS, damping=200.0, force_limit=5000.0)
        numbers.update((name, request.pop(name)) for name in list(request) if name in numbers)
        answer = self.grab(**dict(dict(tree=TREE), **given(**numbers), **request))
        if not answer.success:
            raise AssertionError(answer.message)
        return answer

    def take_at(self, offset, branch=LIMB, along=0.3, **request):
        """Grabs a branch and pulls the held point by `offset` [m]. Returns the reply and the
        target."""
        target = plus(self.point(branch, along), offset)
        request = dict(dict(branch=branch, along=along), **request)
        return self.take(target=stamped(target), **request), target

    def show_frame(self, name, place, turn=(0.0, 0.0, 0.0, 1.0), stamp=None):
        """Broadcasts a frame as soon as the node subscribes to tf."""
        transform = TransformStamped(child_frame_id=name)
        transform.header.frame_id = 'map'
        transform.header.stamp = stamp or time_of(self.clock.tick)
        at, q = transform.transform.translation, transform.transform.rotation
        at.x, at.y, at.z = place
        q.x, q.y, q.z, q.w = turn
        wait_for_readers('/tf', self.process)
        self._frames.publish([transform])

    def wait_for_frame(self, name, place):
        """Waits until the node knows a frame. It sends a request with an invalid stiffness, which
        has no effect, and reads the error."""
        def known():
            self.show_frame(name, place)
            answer = self.grab(tree=TREE, branch=LIMB, frame=name,
                               **given(stiffness=-1.0))
            return 'stiffness' in answer.message
        wait_for(known, 'the frame ' + name)

    def wrench(self):
        """Returns the first wrench of the last tick."""
        stamp = time_of(self.clock.tick)
        return self.wrenches.wait(
            lambda all: next((m for m in all if m.header.stamp == stamp), None), 'a wrench')

    def physical(self, tree=TREE):
        return list(self.tree(tree).physical)

    def let_all_go(self):
        """Releases all grabs and runs until no branch is physical."""
        self.release(all=True)
        self.run(1)
        self.clock.run_until(lambda: not self.physical(), 'a calm tree', self)


def stamped(place):
    return PointStamped(point=Point(*place))


def size(v):
    return math.hypot(*v)

