# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of vegetation_scanner."""
import math

from vegetation_sim.client import Client, header, point
from vegetation_sim.msg import SkyView
from vegetation_sim.srv import GetSkyView


class Sky(Client):
    """How much light of the sky trees, plants and people let through (SkyView)."""

    def __init__(self, node='/vegetation_scanner', timeout=30.0):
        super().__init__(node, timeout)

    def at(self, *places, frame=''):
        """Returns the view from each place (x, y, z) [m]."""
        return self.call('sky_view', GetSkyView, header=header(frame),
                         points=[point(place) for place in places]).views

    def of(self, *frames):
        """Returns the view from the origin of each tf frame."""
        return self.call('sky_view', GetSkyView, frames=list(frames)).views

    @staticmethod
    def transmittance(view, elevation, azimuth):
        """Returns the share of light from a direction of the world: the elevation above the
        horizontal, from 0 to pi/2, and the azimuth, counter-clockwise from x [rad]."""
        if not 0 <= elevation <= math.pi / 2 or not math.isfinite(azimuth):
            raise ValueError('elevation = %g rad, allowed is 0 to pi/2; azimuth = %g rad' % (
                elevation, azimuth))
        row = min(int(elevation / (math.pi / 2) * SkyView.ELEVATIONS), SkyView.ELEVATIONS - 1)
        turn = azimuth / (2 * math.pi) % 1.0
        column = min(int(turn * SkyView.AZIMUTHS), SkyView.AZIMUTHS - 1)
        return view.transmittance[row * SkyView.AZIMUTHS + column]
