#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rolls the stone of paper 2, figure 4, over the ground of the meadow, without slipping.

The stone follows the topic stone/cmd_vel, or rolls to where its interactive marker is dragged in
rviz. Before the first of these it moves on a closed curve, or stands where the parameters x and y
place it. Broadcasts the frame of the stone, under which grass_field treads the grass, and publishes
its marker.

A command is a Twist in a level frame at the stone (REP 103): linear.x and linear.y [m/s], and
angular.z [rad/s], which turns that frame. It begins with the axes of the world.
"""
import math

import rospy
from geometry_msgs.msg import Pose, TransformStamped, Twist
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from tf2_msgs.msg import TFMessage
from vegetation_sim import Ground
from visualization_msgs.msg import (InteractiveMarker, InteractiveMarkerControl,
                                    InteractiveMarkerFeedback, Marker, MarkerArray)

RATE = 50.0  # [Hz]
RADIUS = 0.45  # [m]
WIDE, DEEP, PERIOD = 9.0, 5.0, 40.0  # Half axes of the curve [m] and time of one round [s].
MESH = 'package://vegetation_sim/media/stone/stone.obj'  # of scripts/make_stone.py, with radius 1
DRAWN = 1.08  # largest radius of the mesh, relative to RADIUS; its bumps sink into the ground
MARKER_PERIOD = 1.0  # [s]
TOP_SPEED = 3.0  # [m/s]
TOP_TURN = 3.0  # [rad/s]
FARTHEST = 1e5  # Largest coordinate of a place to which the stone rolls [m].
COMMAND_TIMEOUT = 0.5  # A command expires after this time. [s]
LONGEST_STEP = 0.5  # A command does not act in a longer step of the clock. [s]


def place(seconds):
    angle = 2.0 * math.pi * seconds / PERIOD
    return WIDE * math.sin(angle), DEEP * math.sin(2.0 * angle)


def product(a, b):
    """Returns the product of two quaternions (x y z w)."""
    return (a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2])


def rolled(turn, way, up):
    """Returns the rotation `turn` after rolling by `way` [m] on ground with the normal `up`."""
    length = math.sqrt(sum(part * part for part in way))
    if length == 0.0:
        return turn
    axis = (up[1] * way[2] - up[2] * way[1], up[2] * way[0] - up[0] * way[2],
            up[0] * way[1] - up[1] * way[0])
    half = 0.5 * length / RADIUS
    return product(tuple(part / length * math.sin(half) for part in axis) + (math.cos(half),), turn)


def check(topic, unit, low, high, **values):
    """Raises ValueError unless all values are within low to high."""
    for name, value in values.items():
        if not low <= value <= high:  # also for NaN
            raise ValueError('%s: %s = %g %s is not within %g to %g %s' % (
                topic, name.replace('_', '.'), value, unit, low, high, unit))


class RollingStone:
    def __init__(self):
        self.world = rospy.get_param('~frame_id', 'map')
        self.on_curve = not (rospy.has_param('~x') or rospy.has_param('~y'))
        self.ground, self.heading, self.last = Ground(), 0.0, None
        self.at, self.turn = None, (0.0, 0.0, 0.0, 1.0)
        self.start = tuple(float(rospy.get_param('~' + name, 0.0)) for name in ('x', 'y'))
        self.order = None  # ('twist', forward, left, turn, time) or ('place', x, y)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.marker, self.marked = MarkerArray([self.solid()]), None
        self.markers = rospy.Publisher('stone/markers', MarkerArray, queue_size=1, latch=True)
        self.server = InteractiveMarkerServer('stone')
        self.server.insert(self.handle(), self.on_feedback)
        self.server.applyChanges()
        rospy.Subscriber('stone/cmd_vel', Twist, self.on_command)

    def on_command(self, command):
        x, y, turn = command.linear.x, command.linear.y, command.angular.z
        try:
            check('stone/cmd_vel', 'm/s', -TOP_SPEED, TOP_SPEED, linear_x=x, linear_y=y)
            check('stone/cmd_vel', 'm/s', 0.0, TOP_SPEED, speed=math.hypot(x, y))
            check('stone/cmd_vel', 'rad/s', -TOP_TURN, TOP_TURN, angular_z=turn)
        except ValueError as error:
            rospy.logerr('%s; the command is ignored', error)
            return
        self.order = 'twist', x, y, turn, rospy.Time.now()

    def on_feedback(self, feedback):
        if feedback.event_type != InteractiveMarkerFeedback.POSE_UPDATE:
            return
        to = feedback.pose.position
        try:
            if feedback.header.frame_id != self.world:
                raise ValueError("stone/feedback: frame '%s' is not the world frame '%s'" % (
                    feedback.header.frame_id, self.world))
            check('stone/feedback', 'm', -FARTHEST, FARTHEST, position_x=to.x, position_y=to.y)
        except ValueError as error:
            rospy.logerr('%s; the place is ignored', error)
            return
        self.order = 'place', to.x, to.y

    def next_place(self, now, dt):
        """Returns where the stone is after a step."""
        x, y = self.at
        if self.order is None:
            return place(now.to_sec() % PERIOD) if self.on_curve else self.at
        if self.order[0] == 'place':
            way = self.order[1] - x, self.order[2] - y
            part = min(1.0, TOP_SPEED * dt / max(math.hypot(*way), 1e-9))
            return x + part * way[0], y + part * way[1]
        _, forward, left, turn, since = self.order
        if not 0.0 <= (now - since).to_sec() < COMMAND_TIMEOUT:
            return self.at
        self.heading += turn * dt
        c, s = math.cos(self.heading), math.sin(self.heading)
        return x + dt * (c * forward - s * left), y + dt * (s * forward + c * left)

    def roll(self, now):
        dt = (now - self.last).to_sec() if self.last else 0.0
        self.last = now
        if self.at is None:
            self.at = place(now.to_sec() % PERIOD) if self.on_curve else self.start
            self.centre = self.centre_at(*self.at)[0]
        # The curve follows from the time alone, so that it has no leap after a long step.
        self.at = self.next_place(now, dt if 0.0 < dt < LONGEST_STEP else 0.0)
        before, (self.centre, up) = self.centre, self.centre_at(*self.at)
        way = [b - a for a, b in zip(before, self.centre)]
        if sum(part * part for part in way) < 1.0:  # The first transform of the curve is a jump.
            self.turn = rolled(self.turn, way, up)

    def centre_at(self, x, y):
        """Returns the centre of a stone that touches the ground, and the normal of the ground."""
        height, up = self.ground.at(x, y)
        return (x, y, height + RADIUS / up[2]), up

    def pose(self):
        out = Pose()
        out.position.x, out.position.y, out.position.z = self.centre
        turn = out.orientation
        turn.x, turn.y, turn.z, turn.w = self.turn
        return out

    def publish(self, now):
        out, pose = TransformStamped(child_frame_id='stone'), self.pose()
        out.header.stamp, out.header.frame_id = now, self.world
        at = out.transform.translation
        at.x, at.y, at.z = self.centre
        out.transform.rotation = pose.orientation
        self.tf.publish(TFMessage([out]))
        if self.marked is None or not 0.0 <= (now - self.marked).to_sec() < MARKER_PERIOD:
            self.markers.publish(self.marker)
            self.marked = now
        handle = Pose(position=pose.position)  # Its plane of motion stays level.
        handle.orientation.w = 1.0
        self.server.setPose('stone', handle)
        self.server.applyChanges()

    @staticmethod
    def solid():
        """Returns the marker of the stone, which moves with its frame."""
        out = Marker(ns='stone', type=Marker.MESH_RESOURCE, frame_locked=True)
        out.header.frame_id, out.pose.orientation.w = 'stone', 1.0
        out.scale.x = out.scale.y = out.scale.z = DRAWN * RADIUS
        out.mesh_resource, out.mesh_use_embedded_materials = MESH, True
        return out

    def handle(self):
        """Returns the interactive marker: a ring around the stone that moves in a level plane."""
        out = InteractiveMarker(name='stone', description='', scale=4.0 * RADIUS)
        out.header.frame_id, out.pose.orientation.w = self.world, 1.0
        control = InteractiveMarkerControl(name='level', always_visible=False)
        control.interaction_mode = InteractiveMarkerControl.MOVE_PLANE
        control.orientation.w = control.orientation.y = math.sqrt(0.5)
        out.controls.append(control)
        return out

    def run(self):
        rate = rospy.Rate(RATE)
        while not rospy.is_shutdown():
            now = rospy.Time.now()
            if now != self.last:
                self.roll(now)
                self.publish(now)
            try:
                rate.sleep()
            except rospy.ROSTimeMovedBackwardsException:
                rate = rospy.Rate(RATE)
            except rospy.ROSInterruptException:
                return


if __name__ == '__main__':
    rospy.init_node('rolling_stone')
    RollingStone().run()
