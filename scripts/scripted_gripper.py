#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Moves a gripper without a robot that repeatedly grabs, pulls, holds and releases a branch.

It is an example of what a robot has to do: broadcast the frame of its gripper, call grab and
release, and subscribe to forest/wrenches.
"""
import math

import rospy
from geometry_msgs.msg import Point, TransformStamped, WrenchStamped
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from vegetation_sim.srv import GetTree, Grab, Release
from visualization_msgs.msg import Marker, MarkerArray

RATE = 50.0  # [Hz]
METRES_PER_NEWTON = 0.003  # Length of the force arrow per newton. [m/N]
THINNEST = 0.002  # Radius of the thinnest branch that it grabs. What has come off is thinner. [m]
STEEL, ORANGE, RED = (0.25, 0.27, 0.30), (0.95, 0.45, 0.05), (0.80, 0.05, 0.05)
# Steps of the motion and their durations [s].
SCRIPT = [('come', 3.0), ('close', 0.5), ('pull', 3.0), ('hold', 4.0), ('open', 0.3), ('go', 3.0),
          ('wait', 5.0)]


def smooth(x):
    """Returns a step from 0 to 1 with zero speed and acceleration at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x * x * x * (10.0 + x * (6.0 * x - 15.0))


def mix(a, b, x):
    return [p + (q - p) * x for p, q in zip(a, b)]


def along_z(pose, distance):
    """Returns the point at a distance from the origin of a pose along its z axis."""
    p, q = pose.position, pose.orientation
    axis = (2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
            1 - 2 * (q.x * q.x + q.y * q.y))
    return [p.x + distance * axis[0], p.y + distance * axis[1], p.z + distance * axis[2]]


class ScriptedGripper:
    def __init__(self):
        self.frame = rospy.get_param('~frame', 'gripper')
        self.world = rospy.get_param('~frame_id', 'map')
        self.tree = rospy.get_param('~tree', 0)
        # It grabs a branch near this point. [m]
        self.near = rospy.get_param('~near', [0.1, 2.4, 4.0])
        self.motion = rospy.get_param('~pull', [-0.8, 0.2, -0.2])  # [m]
        # Its waiting position relative to the branch. [m]
        self.away = rospy.get_param('~away', [0.0, 2.0, -0.6])
        self.jaw_length = rospy.get_param('~jaw_length', 0.12)  # [m]
        self.force_limit = rospy.get_param('~force_limit', 500.0)  # [N]
        name = rospy.get_param('~animator', '/forest_animator')
        self.get_tree = rospy.ServiceProxy(name + '/get_tree', GetTree)
        self.grab = rospy.ServiceProxy(name + '/grab', Grab)
        self.release = rospy.ServiceProxy(name + '/release', Release)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.markers = rospy.Publisher('gripper/markers', MarkerArray, queue_size=1)
        self.step, self.since, self.grab_id = 0, None, None
        self.branch, self.held, self.place, self.wrench = None, None, None, None
        rospy.Subscriber('forest/wrenches', WrenchStamped, self.on_wrench)

    def on_wrench(self, message):
        if message.header.frame_id == self.frame:
            self.wrench = message

    def choose(self):
        """Chooses the thickest of the branches that pass near the point `near`, or the nearest one
        if they have broken off."""
        tree = self.get_tree(tree=self.tree)
        if not tree.success:
            rospy.logwarn_throttle(5.0, 'no tree yet: ' + tree.message)
            return False
        found = []
        for i, pose in enumerate(tree.transforms.poses):
            middle = along_z(pose, 0.5 * tree.lengths[i])
            if tree.depths[i] > 0 and tree.radii[i] > THINNEST:
                found.append((math.dist(middle, self.near), i))
        if not found:
            rospy.logwarn_throttle(5.0, 'no branch near %s' % self.near)
            return False
        near = [i for distance, i in found if distance < 0.4]
        best = max(near, key=lambda i: tree.radii[i]) if near else min(found)[1]
        self.branch, self.along = best, 0.9 * tree.lengths[best]
        return True

    def branch_now(self):
        return along_z(self.get_tree(tree=self.tree).transforms.poses[self.branch], self.along)

    def enter(self, name):
        """Runs the actions at the start of a step."""
        if name == 'come':
            self.held = self.branch_now()
        elif name == 'close':
            self.held = self.branch_now()
        elif name == 'pull':
            answer = self.grab(tree=self.tree, branch=self.branch, along=self.along,
                               frame=self.frame, keep_offset=True, has_stiffness=True,
                               jaw_length=self.jaw_length,
                               stiffness=5000.0, has_damping=True, damping=100.0,
                               has_force_limit=True, force_limit=self.force_limit,
                               has_lease=True, lease=1.0)
            self.grab_id = answer.id if answer.success else None
            rospy.loginfo('grab: %s', answer.message)
        elif name == 'wait':
            self.choose()  # The branch may have broken off.
        elif name == 'open' and self.grab_id is not None:
            rospy.loginfo('release: %s', self.release(id=self.grab_id).message)
            self.grab_id, self.wrench = None, None

    def position(self, name, x):
        waiting = [a + b for a, b in zip(self.held, self.away)]
        pulled = [a + b for a, b in zip(self.held, self.motion)]
        beside = [a + b for a, b in zip(pulled, self.away)]
        return {'come': lambda: mix(waiting, self.held, smooth(x)), 'close': lambda: self.held,
                'pull': lambda: mix(self.held, pulled, smooth(x)), 'hold': lambda: pulled,
                'open': lambda: pulled, 'go': lambda: mix(pulled, beside, smooth(x)),
                'wait': lambda: mix(beside, waiting, smooth(x))}[name]()

    def tick(self, event):
        now = event.current_real
        if self.branch is None and not self.choose():
            return
        # This is the first tick, or the clock jumped back.
        if self.since is None or now < self.since:
            self.step, self.since, self.grab_id = 0, now, None
            self.enter('come')
        name, duration = SCRIPT[self.step]
        while (now - self.since).to_sec() >= duration:
            self.since += rospy.Duration.from_sec(duration)
            self.step = (self.step + 1) % len(SCRIPT)
            name, duration = SCRIPT[self.step]
            self.enter(name)
        x = (now - self.since).to_sec() / duration
        self.place = self.position(name, x)
        self.send(now)
        self.draw(name, x)

    def send(self, now):
        transform = TransformStamped(child_frame_id=self.frame)
        transform.header.stamp, transform.header.frame_id = now, self.world
        at = transform.transform.translation
        at.x, at.y, at.z = self.place
        transform.transform.rotation.w = 1.0
        self.tf.publish([transform])

    def draw(self, name, x):
        opening = {'close': 1.0 - x, 'pull': 0.0, 'hold': 0.0, 'open': x}.get(name, 1.0)
        gap = 0.05 + 0.07 * opening
        self.markers.publish(MarkerArray([
            self.box(0, (0.0, 0.30, 0.0), (0.30, 0.12, 0.14), STEEL),
            self.box(1, (0.0, 0.15, gap), (0.12, 0.30, 0.04), ORANGE),
            self.box(2, (0.0, 0.15, -gap), (0.12, 0.30, 0.04), ORANGE),
            self.box(3, (0.0, 1.36, 0.0), (0.10, 2.0, 0.10), STEEL),
            self.arrow(), self.label(name)]))

    def marker(self, number, kind, colour, alpha=1.0):
        out = Marker(ns='gripper', id=number, type=kind, action=Marker.ADD)
        out.header.frame_id = self.world
        out.pose.orientation.w = 1.0
        out.color = ColorRGBA(*colour, alpha)
        out.lifetime = rospy.Duration(1.0)
        return out

    def box(self, number, offset, size, colour):
        out = self.marker(number, Marker.CUBE, colour)
        at = out.pose.position
        at.x, at.y, at.z = [a + b for a, b in zip(self.place, offset)]
        out.scale.x, out.scale.y, out.scale.z = size
        return out

    def force(self):
        """Returns the force of the branch on the gripper [N], or zero if it holds none."""
        if self.wrench is None or self.grab_id is None:
            return [0.0, 0.0, 0.0]
        force = self.wrench.wrench.force
        return [force.x, force.y, force.z]

    def arrow(self):
        out = self.marker(4, Marker.ARROW, RED)
        force = self.force()
        if math.hypot(*force) * METRES_PER_NEWTON < 0.05:
            out.action = Marker.DELETE
        out.scale.x, out.scale.y, out.scale.z = 0.05, 0.11, 0.16
        out.points = [Point(*self.place),
                      Point(*[p + METRES_PER_NEWTON * f for p, f in zip(self.place, force)])]
        return out

    def label(self, name):
        out = self.marker(5, Marker.TEXT_VIEW_FACING, (0.05, 0.05, 0.05))
        at = out.pose.position
        at.x, at.y, at.z = self.place[0], self.place[1] + 0.6, self.place[2] + 0.35
        out.scale.z = 0.28
        out.text = name if self.grab_id is None else '%s: %.0f N' % (name, math.hypot(*self.force()))
        return out


if __name__ == '__main__':
    rospy.init_node('gripper')
    gripper = ScriptedGripper()
    gripper.get_tree.wait_for_service()
    gripper.grab.wait_for_service()
    timer = rospy.Timer(rospy.Duration.from_sec(1.0 / RATE), gripper.tick)
    rospy.spin()
