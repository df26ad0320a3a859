# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of canopy_animator."""
from std_srvs.srv import SetBool
from vegetation_sim.client import Client, header, point
from vegetation_sim.msg import GrassCut
from vegetation_sim.srv import CutPlants


class Plants(Client):
    """Leafy plants that can be cut. Places are (x, y) in the world frame, or in `frame` [m]."""

    def __init__(self, node='/canopy_animator', timeout=30.0):
        super().__init__(node, timeout)

    def cut(self, *outline, height, radius=0.0, frame=''):
        """Cuts the plants of an area at a height above their feet [m]: inside of three places or
        more, or within a radius. Returns the number of plants."""
        area = GrassCut(outline=[point(place) for place in outline], radius=radius, height=height)
        return self.call('cut', CutPlants, header=header(frame), cut=area).plants

    def set_cutting(self, on):
        """Switches all cutting tools that follow frames."""
        self.call('cutting', SetBool, data=on)
