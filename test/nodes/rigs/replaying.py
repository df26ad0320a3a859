# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests that replay a bag share."""
import math

import rosbag

from forest_rig import RATE


def tick_after(path, topics):
    """First tick after all that a bag tells on topics: its player's clock stands before it."""
    with rosbag.Bag(path) as bag:
        last = max(stamp for _, _, stamp in bag.read_messages(topics))
    return math.ceil(last.to_sec() * RATE) + 1
