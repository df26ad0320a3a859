#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Operates rviz like a user: grabs, drags and releases a branch, treads the grass and draws a gust
with the panel.

xdotool sends real clicks to the window. The script checks the messages that the nodes receive, and
writes them to services.log, with screenshots, in the folder that is its argument.
"""
import math
import os
import subprocess
import sys
import time

import rospy
from geometry_msgs.msg import Point
from vegetation_sim.msg import ForestEvent, TreadEvent, Viewer, WindField
from vegetation_sim.srv import GetTree, SampleGrass, SampleGrassRequest

DEADLINE = 30.0  # [s] of wall time
GUST_BUTTON = (80, 425)  # position of the panel's button in mouse.rviz, in pixels of the window
KINDS = {ForestEvent.GRAB: 'grab', ForestEvent.MOVE: 'move', ForestEvent.RELEASE: 'release'}


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, stdout=subprocess.PIPE,
                          universal_newlines=True).stdout


def until(what, done):
    end = time.monotonic() + DEADLINE
    while time.monotonic() < end:
        found = done()
        if found:
            return found
        rospy.rostime.wallsleep(0.05)
    sys.exit('scripted_mouse: %s did not happen' % what)


def rotated(q, v):
    """Returns a vector rotated by a quaternion."""
    x, y, z = v
    tx, ty, tz = (2 * (q.y * z - q.z * y), 2 * (q.z * x - q.x * z), 2 * (q.x * y - q.y * x))
    return (x + q.w * tx + q.y * tz - q.z * ty, y + q.w * ty + q.z * tx - q.x * tz,
            z + q.w * tz + q.x * ty - q.y * tx)


class Hand:
    def __init__(self, folder):
        self.folder = folder
        self.log_file = open(os.path.join(folder, 'services.log'), 'w')
        self.viewer, self.events, self.treads, self.wind = None, [], [], None
        rospy.Subscriber('viewer', Viewer, lambda m: setattr(self, 'viewer', m))
        rospy.Subscriber('forest/events', ForestEvent, self.on_event, queue_size=1000)
        rospy.Subscriber('tread', TreadEvent, self.treads.append, queue_size=1000)
        rospy.Subscriber('wind', WindField, lambda m: setattr(self, 'wind', m))
        self.get_tree = rospy.ServiceProxy('/forest_animator/get_tree', GetTree)
        self.sample = rospy.ServiceProxy('/grass_field/sample', SampleGrass)
        self.window = run('xdotool', 'search', '--onlyvisible', '--name', 'RViz$').split()[0]

    def log(self, text):
        print(text)
        self.log_file.write('%.3f %s\n' % (rospy.get_time(), text))
        self.log_file.flush()

    def on_event(self, event):
        if event.kind in KINDS:
            self.events.append(event)
            held = ', tree %d, branch %d' % (event.grab.tree, event.grab.branch)
            self.log('forest/events: %s of grab %d%s' % (
                KINDS[event.kind], event.grab.id, held if event.kind == ForestEvent.GRAB else ''))

    def picture(self, name):
        run('import', '-window', 'root', os.path.join(self.folder, name + '.png'))

    def panel(self):
        """Returns left, top, width and height of the 3D view: the only window in rviz with the
        height of the viewer."""
        for line in run('xwininfo', '-tree', '-id', self.window).splitlines():
            words = line.replace('(has no name)', '').split()
            if len(words) < 4 or not words[0].startswith('0x'):
                continue
            size = [w for w in words if 'x' in w and '+' in w and w[0].isdigit()][0]
            width, height = (int(n) for n in size.split('+')[0].split('x'))
            left, top = (int(n) for n in words[-1].split('+')[1:])
            if height == self.viewer.height and width > height / 2:
                return left, top, width, height
        return None

    def pixel(self, point):
        """Returns the pixel of a world point in the root window."""
        left, top, width, height = self.panel()
        pose = self.viewer.pose
        away = [a - b for a, b in zip(point, (pose.position.x, pose.position.y, pose.position.z))]
        q = pose.orientation
        inverse = type(q)(-q.x, -q.y, -q.z, q.w)
        forward, to_left, up = rotated(inverse, away)
        scale = 0.5 * height / math.tan(0.5 * self.viewer.field_of_view) / forward
        return int(left + 0.5 * width - to_left * scale), int(top + 0.5 * height - up * scale)

    def stroke(self, a, b, steps=12, shots=()):
        """Presses the button at a and drags to b; then takes a screenshot for each name in
        `shots`."""
        run('xdotool', 'mousemove', *a)
        rospy.rostime.wallsleep(0.4)
        run('xdotool', 'mousedown', 1)
        rospy.rostime.wallsleep(0.6)
        for i in range(1, steps + 1):
            run('xdotool', 'mousemove', *(int(p + (q - p) * i / steps) for p, q in zip(a, b)))
            rospy.rostime.wallsleep(0.15)
        for name in shots:
            rospy.rostime.wallsleep(1.0)
            self.picture(name)

    def tree(self):
        return self.get_tree(tree=0)

    def point(self, tree, branch, along):
        pose = tree.transforms.poses[branch]
        axis = rotated(pose.orientation, (0.0, 0.0, along))
        return [pose.position.x + axis[0], pose.position.y + axis[1], pose.position.z + axis[2]]

    def use(self, key):
        left, top, width, height = self.panel()
        run('xdotool', 'mousemove', left + width // 2, top + height - 20, 'key', key)
        rospy.rostime.wallsleep(0.5)


def grab(hand):
    tree = until('a tree', hand.tree)
    # A strong limb that is about horizontal in the image.
    limbs = [i for i, d in enumerate(tree.depths) if d == 1]
    limb = max(limbs, key=lambda i: tree.lengths[i])
    hand.picture('grab-1-before')
    hand.use('b')
    start = hand.pixel(hand.point(tree, limb, 0.5 * tree.lengths[limb]))
    hand.stroke(start, (start[0] + 90, start[1] + 40), shots=['grab-2-held'])
    taken = until('a grab', lambda: [e for e in hand.events if e.kind == ForestEvent.GRAB])[-1].grab
    rest = hand.point(tree, taken.branch, taken.along)
    away = math.dist(hand.point(hand.tree(), taken.branch, taken.along), rest)
    hand.log('held point of branch %d is %.3f m from where it was' % (taken.branch, away))
    run('xdotool', 'mouseup', 1)
    until('a release', lambda: [e for e in hand.events if e.kind == ForestEvent.RELEASE])
    path = []
    end = time.monotonic() + 6.0
    while time.monotonic() < end:
        away_now = math.dist(hand.point(hand.tree(), taken.branch, taken.along), rest)
        if not path or away_now != path[-1]:  # Several requests may fall into one tick.
            path.append(away_now)
    least = min(path)
    hand.picture('grab-3-released')
    turns = sum(1 for a, b, c in zip(path, path[1:], path[2:]) if b < a and b < c)
    hand.log('released: it came back to %.3f m, with %d turning points' % (least, turns))
    if away < 0.15 or least > 0.3 * away or turns < 2:
        sys.exit('scripted_mouse: the branch did not follow and recoil')


def tread(hand):
    a, b = (-2.2, 0.2, 0.0), (3.0, -0.8, 0.0)
    middle = [0.5 * (p + q) for p, q in zip(a, b)]

    def tilt():
        request = SampleGrassRequest(points=[Point(*middle)])
        return hand.sample(request).samples[0].tilt

    upright = tilt()
    hand.use('t')
    hand.picture('tread-1-before')
    hand.stroke(hand.pixel(a), hand.pixel(b), steps=24, shots=['tread-2-stroke'])
    run('xdotool', 'mouseup', 1)
    until('a tread', lambda: len(hand.treads) > 5)
    rospy.rostime.wallsleep(1.0)
    hand.picture('tread-3-after')
    hand.log('tread: %d messages; grass half way leans %.2f rad, before %.2f' % (
        len(hand.treads), tilt(), upright))
    if tilt() < upright + 0.5:
        sys.exit('scripted_mouse: the grass was not trodden')


def gust(hand):
    before = len(until('wind', lambda: hand.wind).primitives)
    run('xdotool', 'mousemove', *GUST_BUTTON, 'click', 1)
    rospy.rostime.wallsleep(0.5)
    hand.stroke(hand.pixel((-2.5, 2.0, 0.0)), hand.pixel((3.5, 1.0, 0.0)), shots=['gust-1-stroke'])
    run('xdotool', 'mouseup', 1)
    until('a gust', lambda: len(hand.wind.primitives) > before)
    gust = hand.wind.primitives[-1]
    hand.log('wind: primitive %s at %.1f m/s' % (gust.name, math.hypot(gust.velocity.x, gust.velocity.y)))
    for number in (2, 3):
        rospy.rostime.wallsleep(1.2)
        hand.picture('gust-%d-blows' % number)


def main():
    rospy.init_node('scripted_mouse', anonymous=True)
    hand = Hand(sys.argv[1])
    until('a viewer', lambda: hand.viewer and hand.panel())
    rospy.rostime.wallsleep(6.0)  # Trees and ground are drawn after this time.
    grab(hand)
    tread(hand)
    gust(hand)


if __name__ == '__main__':
    main()
