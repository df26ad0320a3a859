# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A flood of good messages that is larger than the queue of a node."""
import threading

import rospy
from geometry_msgs.msg import Point
from vegetation_sim.msg import TreadEvent

from scene import NANOSECONDS
from watched_node import publisher

COUNT = 6000        # of which 5000 have room
AHEAD = 25.0, 55.0  # stamps after the present [s]; none falls due while others are on their way
CONNECTION = 0.5    # [s] of wall time


def flood_queue(now):
    """Publishes more treads for later stamps than grass_field keeps."""
    surge = publisher('/tread', TreadEvent)
    threading.Event().wait(CONNECTION)
    for number in range(COUNT):
        part = number / COUNT
        message = TreadEvent(source='surge', action=TreadEvent.PLACE,
                             position=Point(8.0 * part - 4.0, 4.0 - 8.0 * part, 0.0))
        ahead = AHEAD[0] + part * (AHEAD[1] - AHEAD[0])
        message.header.stamp = rospy.Time(0, int((now + ahead) * NANOSECONDS))
        surge.publish(message)
    surge.unregister()
