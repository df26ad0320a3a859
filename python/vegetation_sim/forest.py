# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of forest_animator."""
import threading

import rospy
from geometry_msgs.msg import Vector3Stamped
from vegetation_sim.client import (Client, VegetationError, given, header, numbers, point, stamped,
                                   vector)
from vegetation_sim.msg import GrabStatuses
from vegetation_sim.srv import ApplyForce, CutBranch, FindTrees, GetTree, Grab, MoveGrab, Pick, Release

PAGE = 100  # trees, the largest of ~find_trees
RENEWALS = 3.0  # per lease


class Forest(Client):
    """Trees that can be found, grabbed and pushed. Points are in the world frame [m]."""

    def __init__(self, node='/forest_animator', timeout=30.0):
        super().__init__(node, timeout)

    def trees(self, centre=None, radius=None):
        """Yields the trees (FoundTree), all or those within a radius, the nearest first."""
        if (centre is None) != (radius is None):
            raise ValueError('centre and radius go together')
        place = dict(all=True) if centre is None else dict(centre=stamped(centre), radius=radius)
        offset, total = 0, 1
        while offset < total:
            page = self.call('find_trees', FindTrees, offset=offset, limit=PAGE, **place)
            yield from page.trees
            offset, total = offset + PAGE, page.total

    def tree(self, tree):
        """Returns skeleton and pose of a tree as the response of ~get_tree."""
        return self.call('get_tree', GetTree, tree=tree)

    def pick(self, origin, direction, tolerance=0.0, frame=''):
        """Returns tree, branch, along and point of the first branch that a ray hits."""
        return self.call('pick', Pick, header=header(frame), origin=point(origin),
                         direction=vector(direction), tolerance=tolerance)

    def grab(self, tree=None, branch=None, along=0.0, near=None, target=None, frame='', offset=None,
             lease=5.0, stiffness=None, damping=None, force_limit=None, jaw_length=0.0):
        """Grabs a branch. Returns a Hold.

        The place is `tree`, `branch` and `along` [m], or the branch nearest to the point `near`; if
        neither is given, that nearest to the origin of `frame`. The held point follows `target`, or
        the point `offset` of the tf frame `frame`; if none is given, it is held where it is. A jaw
        of `jaw_length` [m] also keeps the branch's direction in the frame.
        """
        if frame and target is not None:
            raise ValueError('needs either target or frame')
        place = self._place(tree, branch, along, near, frame)
        if frame:
            follow = dict(frame=frame, offset=point(offset or (0, 0, 0)), keep_offset=offset is None)
        else:
            follow = dict(target=stamped(self._here(place) if target is None else target))
        spring = given(stiffness=stiffness, damping=damping, force_limit=force_limit, lease=lease)
        answer = self.call('grab', Grab, jaw_length=jaw_length, **place, **follow, **spring)
        return Hold(self, answer, lease)

    def push(self, force, duration, tree=None, branch=None, along=0.0, near=None):
        """Pushes a branch with a constant force [N] in the world frame for a duration [s]."""
        return self.call('apply_force', ApplyForce, duration=duration,
                         force=Vector3Stamped(vector=vector(force)),
                         **self._place(tree, branch, along, near, ''))

    def cut(self, tree=None, branch=None, near=None):
        """Cuts off a branch, or that nearest to the point `near`, with all that it carries. Returns
        its tree, branch and joint."""
        place = self._place(tree, branch, 0.0, near, '')
        place.pop('along', None)
        return self.call('cut_branch', CutBranch, **place)

    def release_all(self):
        self.call('release', Release, all=True)

    def grabs(self):
        """Returns the grabs in force, and why the latest have ended (GrabStatuses)."""
        return rospy.wait_for_message(self.topic('forest/grabs'), GrabStatuses, self.timeout)

    def _place(self, tree, branch, along, near, frame):
        if (tree is None) != (branch is None):
            raise ValueError('tree and branch go together')
        if tree is not None and near is not None:
            raise ValueError('needs either tree and branch, or near')
        if tree is not None:
            return dict(tree=tree, branch=branch, along=along)
        if near is not None and len(near) != 3:
            raise ValueError('near needs x, y and z, not %s' % (near,))
        if near is None and not frame:
            raise ValueError('needs tree and branch, near, or frame')
        here = stamped((0, 0, 0), frame) if near is None else stamped(near)
        return dict(nearest=True, point=here)

    def _here(self, place):
        """Returns the point of a place in the world frame."""
        if 'point' in place:
            return numbers(place['point'].point)
        pose = self.tree(place['tree']).transforms.poses[place['branch']]
        q, base = pose.orientation, numbers(pose.position)
        axis = (2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x ** 2 + q.y ** 2))
        return [b + place['along'] * a for b, a in zip(base, axis)]


class Hold:
    """A branch that is held. It is released at the end of a `with` block, and its lease is renewed
    until then."""

    def __init__(self, forest, grab, lease):
        self._forest = forest
        self.id, self.tree, self.branch, self.along = grab.id, grab.tree, grab.branch, grab.along
        self._timer = rospy.Timer(rospy.Duration(lease / RENEWALS), self._keep, reset=True)

    def move(self, target):
        """Moves the target of a grab without a frame. Returns the distance to it [m]."""
        return self._ask(target=stamped(target)).distance

    @property
    def force(self):
        """Force of the branch on the holder at the last tick [N], in world axes."""
        return numbers(self._ask(renew_only=True).force)

    @property
    def point(self):
        """The held point at the last tick [m], in the world frame."""
        return numbers(self._ask(renew_only=True).point)

    def result(self, timeout=5.0):
        """Waits until the grab has ended, at most `timeout` [s] of wall time. Returns its
        GrabStatus, whose `status` is the reason, or None if it is still in force."""
        ended, found = threading.Event(), []

        def find_status(message):
            found.extend(status for status in message.ended if status.grab.id == self.id)
            if found:
                ended.set()
        subscriber = rospy.Subscriber(self._forest.topic('forest/grabs'), GrabStatuses, find_status)
        ended.wait(timeout)
        subscriber.unregister()
        return found[0] if found else None

    def release(self):
        """Releases the branch."""
        self._timer.shutdown()
        self._forest.call('release', Release, id=self.id)

    def _ask(self, **request):
        return self._forest.call('move_grab', MoveGrab, id=self.id, **request)

    def _keep(self, _):
        try:
            self._ask(renew_only=True)
        except VegetationError as error:  # The next call of the user reports it too.
            self._timer.shutdown()
            rospy.logwarn('grab %d has ended: %s', self.id, error)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        try:
            self.release()
        except VegetationError:
            if kind is None:  # An exception of the block is more important.
                raise
