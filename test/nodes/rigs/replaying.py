# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixture for the tests that replay a bag."""
import math

import rosbag

from forest_rig import RATE


def tick_after(path, topics):
    """Returns the first tick after all messages of the bag on these topics. The clock of the player
    stops before it."""
    with rosbag.Bag(path) as bag:
        last = max(stamp for _, _, stamp in bag.read_messages(topics))
    return math.ceil(last.to_sec() * RATE) + 1
