# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The ground on which a meadow stands."""
import math

import rospy
from vegetation_sim.client import VegetationError
from vegetation_sim.grass import Grass
from vegetation_sim.msg import GrassLayout

SLOPE_STEP = 0.1  # Distance of the points that give the slope of the ground [m].


class Ground:
    """Height and normal of the ground. It is flat unless the layout of grass_field, which may come
    later, names a height map."""

    def __init__(self, node='grass_field'):
        self._node = rospy.resolve_name(node)
        self._grass, self._last = None, (0.0, (0.0, 0.0, 1.0))
        self._subscriber = rospy.Subscriber('grass/layout', GrassLayout, self._on_layout)

    def _on_layout(self, layout):
        if layout.terrain and not self._grass:
            self._grass = Grass(self._node)

    def at(self, x, y):
        """Returns height [m] and upward unit normal at (x, y) in the world frame [m], or the last
        ones, with a warning, if grass_field does not answer."""
        if not self._grass:
            return self._last
        try:
            here, east, north = (sample.position.z for sample in self._grass.at(
                (x, y), (x + SLOPE_STEP, y), (x, y + SLOPE_STEP)))
        except VegetationError as error:
            rospy.logwarn_throttle(5.0, str(error))
            return self._last
        normal = ((here - east) / SLOPE_STEP, (here - north) / SLOPE_STEP, 1.0)
        length = math.sqrt(sum(part * part for part in normal))
        self._last = here, tuple(part / length for part in normal)
        return self._last
