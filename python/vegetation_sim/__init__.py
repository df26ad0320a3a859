# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Clients of the nodes of vegetation_sim; docs/python.md describes them."""
from vegetation_sim.client import VegetationError
from vegetation_sim.crowd import Crowd
from vegetation_sim.forest import Forest, Hold
from vegetation_sim.grass import Grass
from vegetation_sim.ground import Ground
from vegetation_sim.plants import Plants
from vegetation_sim.recording import Recording
from vegetation_sim.scene import Scene
from vegetation_sim.simulation import Simulation
from vegetation_sim.sky import Sky
from vegetation_sim.wind import Wind

__all__ = ['Crowd', 'Forest', 'Grass', 'Ground', 'Hold', 'Plants', 'Recording', 'Scene', 'Simulation',
           'Sky', 'VegetationError', 'Wind']
