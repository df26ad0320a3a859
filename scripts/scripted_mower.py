#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives a mower without a robot to and fro through branches and plants, which its hull and mast
push aside; or lane by lane over a meadow or a field, if ~lanes is above 0.

It is an example of what a robot has to do: broadcast its frame and subscribe to forest/wrenches and
canopy/contacts. config/robots/mower.urdf describes the mower; this node draws its deck and
the force.
"""
import math
from collections import deque

import rospy
from geometry_msgs.msg import Point, TransformStamped, WrenchStamped
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import PlantContacts
from visualization_msgs.msg import Marker, MarkerArray

RATE = 50.0  # [Hz]
METRES_PER_NEWTON = 0.01  # Length of the force arrow per newton. [m/N]
SMOOTHING = 0.3  # Window of the mean that the label and the arrow show. [s]
RED, WHITE = (0.80, 0.05, 0.05, 1.0), (1.0, 1.0, 1.0, 1.0)


class ScriptedMower:
    def __init__(self):
        self.frame = rospy.get_param('~frame', 'mower')
        self.world = rospy.get_param('~frame_id', 'map')
        self.speed = rospy.get_param('~speed', 0.8)  # [m/s]
        # Distance of the turning points from the middle. [m]
        self.way = rospy.get_param('~way', 5.0)
        self.lanes = rospy.get_param('~lanes', 0)
        self.lane_width = rospy.get_param('~lane_width', 1.0)  # [m]
        # Drawn deck: how far ahead it is, its length and width, and its height above the ground. [m]
        self.deck = rospy.get_param('~deck', [0.2, 0.5, 1.1, 0.12])
        self.start, self.pose = None, (-self.way, 0.0, 0.0)  # x, y, yaw
        self.wrenches = deque()
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=100)
        self.markers = rospy.Publisher('mower/markers', MarkerArray, queue_size=1)
        rospy.Subscriber('forest/wrenches', WrenchStamped, self.on_wrench, queue_size=1000)
        rospy.Subscriber('canopy/contacts', PlantContacts, self.on_contacts, queue_size=1000)

    def on_wrench(self, message):
        if message.header.frame_id == self.frame:
            self.wrenches.append((message.header.stamp, message.wrench.force))

    def on_contacts(self, message):
        self.wrenches.extend((message.header.stamp, contact.wrench.force)
                             for contact in message.contacts if contact.frame == self.frame)

    def force(self, now):
        """Returns the force of all branches and plants on the mower, averaged over the last ticks
        [N]."""
        while self.wrenches and (now - self.wrenches[0][0]).to_sec() > SMOOTHING:
            self.wrenches.popleft()
        ticks = len({stamp for stamp, _ in self.wrenches})
        total = [0.0, 0.0, 0.0]
        for _, f in list(self.wrenches):
            total = [a + b / ticks for a, b in zip(total, (f.x, f.y, f.z))]
        return total

    def tick(self, event):
        now = event.current_real
        if self.start is None or now < self.start:
            self.start = now
        distance = (now - self.start).to_sec() * self.speed
        self.pose = self.on_lanes(distance) if self.lanes else self.to_and_fro(distance)
        self.send(now)
        self.draw(now)

    def to_and_fro(self, distance):
        """Returns the pose on a line; the mower slows down where it turns."""
        phase = distance / (2.0 * self.way)
        x = self.way * math.asin(0.999 * math.sin(math.pi * (phase - 0.5))) / (0.5 * math.pi)
        return x, 0.0, 0.0

    def on_lanes(self, distance):
        """Returns the pose on parallel lanes, which half circles connect. The mower stops at the
        end of the last one."""
        length, radius = 2.0 * self.way, 0.5 * self.lane_width
        turn = math.pi * radius
        distance = min(distance, self.lanes * (length + turn) - turn)
        lane = min(int(distance / (length + turn)), self.lanes - 1)
        along = distance - lane * (length + turn)
        sign = 1.0 if lane % 2 == 0 else -1.0
        south = (lane - 0.5 * self.lanes) * self.lane_width
        if along <= length:
            return sign * (along - self.way), south, 0.0 if sign > 0.0 else math.pi
        angle = (along - length) / radius
        x, y = sign * (self.way + radius * math.sin(angle)), south + radius * (1.0 - math.cos(angle))
        return x, y, angle if sign > 0.0 else math.pi - angle

    def send(self, now):
        transform = TransformStamped(child_frame_id=self.frame)
        transform.header.stamp, transform.header.frame_id = now, self.world
        x, y, yaw = self.pose
        transform.transform.translation.x, transform.transform.translation.y = x, y
        transform.transform.rotation.z = math.sin(0.5 * yaw)
        transform.transform.rotation.w = math.cos(0.5 * yaw)
        self.tf.publish([transform])

    def draw(self, now):
        force = self.force(now)
        if not self.lanes:
            self.markers.publish(MarkerArray([self.arrow(force), self.label(force)]))
            return
        ahead, length, width, height = self.deck
        deck = self.marker(3, Marker.MESH_RESOURCE)
        deck.mesh_resource = 'package://vegetation_sim/media/robots/deck.obj'
        deck.mesh_use_embedded_materials = True
        deck.pose.position.x, deck.pose.position.z = ahead, height
        deck.scale.x, deck.scale.y, deck.scale.z = length, width, 0.08
        self.markers.publish(MarkerArray([deck]))

    def marker(self, number, kind, *colour):
        out = Marker(ns='mower', id=number, type=kind, action=Marker.ADD)
        out.header.frame_id, out.frame_locked = self.frame, True
        out.pose.orientation.w = 1.0
        out.color = ColorRGBA(*colour)
        out.lifetime = rospy.Duration(1.0)
        return out

    def arrow(self, force):
        out = self.marker(4, Marker.ARROW, *RED)
        if math.hypot(*force) * METRES_PER_NEWTON < 0.05:
            out.action = Marker.DELETE
        out.scale.x, out.scale.y, out.scale.z = 0.05, 0.11, 0.16
        foot = (0.1, 0.0, 1.6)
        out.points = [Point(*foot), Point(*[p + METRES_PER_NEWTON * f for p, f in zip(foot, force)])]
        return out

    def label(self, force):
        out = self.marker(5, Marker.TEXT_VIEW_FACING, *WHITE)
        out.pose.position.x, out.pose.position.z = 0.1, 2.6
        out.scale.z = 0.26
        out.text = '%.0f N' % math.hypot(*force)
        return out


if __name__ == '__main__':
    rospy.init_node('mower')
    mower = ScriptedMower()
    rospy.Timer(rospy.Duration.from_sec(1.0 / RATE), mower.tick, reset=True)
    rospy.spin()
