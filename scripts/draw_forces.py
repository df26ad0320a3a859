#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the force of branches and plants on a body over time, of a scene that runs.

usage: draw_forces.py FRAME SECONDS FILE.png

FRAME is the frame of the body as in forest/wrenches and canopy/contacts, in which the forces are
given. Prints the largest force in each direction [N].
"""
import math
import sys
from collections import defaultdict

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plot  # noqa: E402
import rospy  # noqa: E402
from geometry_msgs.msg import WrenchStamped  # noqa: E402
from vegetation_sim.msg import PlantContacts  # noqa: E402

AXES = ('forward (x)', 'left (y)', 'up (z)')
COLOURS = ('#0072b2', '#d55e00', '#009e73')  # Okabe and Ito


class ForceRecord:
    """Sums of the forces on one body at each stamp."""

    def __init__(self, frame):
        self.frame = frame
        self.sums = defaultdict(lambda: [0.0, 0.0, 0.0])
        rospy.Subscriber('forest/wrenches', WrenchStamped, self.on_wrench, queue_size=10000)
        rospy.Subscriber('canopy/contacts', PlantContacts, self.on_contacts, queue_size=10000)

    def add(self, stamp, force):
        total = self.sums[stamp.to_sec()]
        for axis, part in enumerate((force.x, force.y, force.z)):
            total[axis] += part

    def on_wrench(self, message):
        if message.header.frame_id == self.frame:
            self.add(message.header.stamp, message.wrench.force)

    def on_contacts(self, message):
        self.sums[message.header.stamp.to_sec()]  # a stamp without contacts has no force
        for contact in message.contacts:
            if contact.frame == self.frame:
                self.add(message.header.stamp, contact.wrench.force)

    def series(self):
        """Returns times from the first stamp on [s], and the forces by axis [N]."""
        stamps = sorted(self.sums)
        return [stamp - stamps[0] for stamp in stamps], \
            [[self.sums[stamp][axis] for stamp in stamps] for axis in range(3)]


def draw(frame, times, forces, path):
    figure, axes = plot.subplots(figsize=(9.0, 3.6))
    for label, colour, values in zip(AXES, COLOURS, forces):
        axes.plot(times, values, color=colour, linewidth=1.2, label=label)
    axes.set(xlabel='time [s]', ylabel='force on %s [N]' % frame)
    axes.grid(alpha=0.3)
    axes.legend(loc='best')
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    try:
        frame, seconds, path = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    except (IndexError, ValueError):
        sys.exit(__doc__)
    if not (math.isfinite(seconds) and seconds > 0.0):
        sys.exit('draw_forces.py: SECONDS is %s, not above 0' % seconds)
    rospy.init_node('draw_forces', anonymous=True, disable_signals=True)
    record = ForceRecord(frame)
    rospy.sleep(seconds)
    times, forces = record.series() if record.sums else ([], [])
    if not any(any(values) for values in forces):
        sys.exit('draw_forces.py: nothing has touched %s in %g s' % (frame, seconds))
    draw(frame, times, forces, path)
    for label, values in zip(AXES, forces):
        print('%s: %.1f to %.1f N' % (label, min(values), max(values)))


if __name__ == '__main__':
    main()
