# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests that replay a bag share."""
import math

import rosbag

from forest_rig import RATE


def tick_after(path):
    """First tick after all that a bag tells."""
    with rosbag.Bag(path) as bag:
        return math.ceil(bag.get_end_time() * RATE) + 1
