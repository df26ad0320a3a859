# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of wind_broadcaster."""
from vegetation_sim.client import Client, header, numbers, point, stamped, vector
from vegetation_sim.msg import WindPrimitive
from vegetation_sim.srv import RemoveWindPrimitive, SampleWind, SetWindPrimitive


class Wind(Client):
    """Sources of wind. Velocities point where the air goes, in the world frame [m/s]."""

    def __init__(self, node='/wind_broadcaster', timeout=30.0):
        super().__init__(node, timeout)

    def set(self, name, kind, velocity=(0, 0, 0), position=None, **fields):
        """Adds a source or replaces that of the name. `kind` and `fields` are those of
        WindPrimitive. Returns the stamp at which it begins."""
        path = [] if position is None else [stamped(position)]
        source = WindPrimitive(name=name, kind=kind, velocity=vector(velocity), trajectory=path,
                               **fields)
        return self.call('set_primitive', SetWindPrimitive, primitive=source).t_on

    def breeze(self, velocity, turbulence=0.2, length_scale=40.0, name='breeze', fade=2.0):
        """Sets a turbulent wind that is the same everywhere in the mean."""
        return self.set(name, WindPrimitive.BREEZE, velocity, turbulence=turbulence,
                        length_scale=length_scale, fade_in=fade, fade_out=fade)

    def remove(self, name):
        self.call('remove_primitive', RemoveWindPrimitive, name=name)

    def clear(self):
        """Removes all sources."""
        self.call('remove_primitive', RemoveWindPrimitive, all=True)

    def at(self, *places, frame='', stamp=None):
        """Returns the velocity of the air at each place, now or at a stamp."""
        response = self.call('sample', SampleWind, header=header(frame, stamp),
                             positions=[point(place) for place in places])
        return [numbers(velocity) for velocity in response.velocities]
