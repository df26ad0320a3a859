# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Client of grass_field."""
from vegetation_sim.client import Client, given, header, point, stamped
from std_srvs.srv import SetBool
from vegetation_sim.msg import GrassCut, TreadLaw
from vegetation_sim.srv import ClearGrass, CutGrass, SampleGrass, Tread


class Grass(Client):
    """A meadow that can be trodden. Places are (x, y) in the world frame [m]."""

    def __init__(self, node='/grass_field', timeout=30.0):
        super().__init__(node, timeout)

    def tread(self, *places, radius=None, reach=None, softness=None, load=None, recovery=None):
        """Treads a path. What is None is the node's. Returns the length of the path [m]."""
        law = TreadLaw(**given(radius=radius, reach=reach, softness=softness, load=load,
                               recovery=recovery))
        return self.call('tread', Tread, points=[point(place) for place in places], law=law).length

    def cut(self, *outline, height, radius=0.0, swath=(), frame=''):
        """Cuts an area at a height [m]: inside of three places or more, or within a radius."""
        area = GrassCut(outline=[point(place) for place in outline], radius=radius, height=height,
                        swath=[point(place) for place in swath])
        self.call('cut', CutGrass, header=header(frame), cut=area)

    def set_cutting(self, on):
        """Switches all cutting tools that follow frames."""
        self.call('cutting', SetBool, data=on)

    def at(self, *places, frame=''):
        """Returns the grass at each place (GrassSample) at the last tick."""
        return self.call('sample', SampleGrass, header=header(frame),
                         points=[point(place) for place in places]).samples

    def clear(self, centre=None, radius=None):
        """Raises the grass of a disc, or everywhere without centre and radius."""
        if (centre is None) != (radius is None):
            raise ValueError('centre and radius go together')
        if centre is None:
            self.call('clear', ClearGrass, all=True)
        else:
            self.call('clear', ClearGrass, centre=stamped(centre), radius=radius)
