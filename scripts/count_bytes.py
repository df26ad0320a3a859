#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the bytes of a topic that has a message at each tick. Sets the clock.

usage: count_bytes.py TOPIC TICKS RATE
"""
import sys
import threading

import rospy
from rosgraph_msgs.msg import Clock

WAIT = 0.5  # [s] of wall time after which the same time is published again


def main(topic, ticks, rate):
    rospy.init_node('count_bytes', anonymous=True)
    clock = rospy.Publisher('/clock', Clock, queue_size=10)
    sizes, arrived = [], threading.Event()

    def on_message(message):
        sizes.append(len(message._buff))
        arrived.set()

    rospy.Subscriber(topic, rospy.AnyMsg, on_message, queue_size=100)
    # The clock of the last run goes on.
    tick = int(rospy.get_param('/counted_ticks', 3000))
    while len(sizes) < ticks and not rospy.is_shutdown():
        arrived.clear()
        tick += 1
        count = len(sizes)
        while len(sizes) == count and not rospy.is_shutdown():
            clock.publish(Clock(clock=rospy.Time.from_sec((tick + 0.5) / rate)))
            arrived.wait(WAIT)
    rospy.set_param('/counted_ticks', tick)
    mean = sum(sizes) / len(sizes)
    print('%s: %.0f bytes a message, %.2f MB/s' % (topic, mean, 1e-6 * rate * mean), flush=True)


if __name__ == '__main__':
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]), float(sys.argv[3]))
