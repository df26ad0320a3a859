# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Names of the nodes and topics of the chaos test, and numbers that several modules use."""
from vegetation_sim.msg import CanopyEvent, CrowdEvent, ForestEvent, GrassEvent

START = 1000.0  # first time of the clock [s]
NANOSECONDS = 10 ** 9

# Nodes whose state is a function of recorded events: the topic of the states, the topic and type of
# the events, and the kinds of events that are outputs.
SIMULATIONS = {
    'forest_animator': ('forest/state', 'forest/events', ForestEvent, ()),
    'grass_field': ('grass/state', 'grass/events', GrassEvent, (GrassEvent.ENTER,)),
    'canopy_animator': ('canopy/state', 'canopy/events', CanopyEvent, ()),
    'agent_crowd': ('agents', 'agents/events', CrowdEvent, ()),
}
# A topic that each node publishes at each tick.
TICKS = dict({node: row[0] for node, row in SIMULATIONS.items()},
             wind_broadcaster='wind/samples', vegetation_scanner='lidar/report')
NODES = tuple(TICKS)
# Subscribers of topics that one node owns, which name a second publisher.
OWNED = {
    'wind': ('forest_animator', 'grass_field', 'canopy_animator', 'vegetation_scanner'),
    'forest/layout': ('agent_crowd', 'vegetation_scanner'),
    'grass/cover/resistance': ('agent_crowd',),
    'forest/state': ('vegetation_scanner',),
    'grass/layout': ('vegetation_scanner',),
    'grass/near': ('vegetation_scanner',),
    'canopy/layout': ('vegetation_scanner',),
    'canopy/state': ('vegetation_scanner',),
    'agents/near': ('vegetation_scanner',),
}
# Nodes that follow frames of the robot, and the text of the diagnostics when one is lost.
FOLLOWERS = {
    'forest_animator': "no transform from 'arm'",
    'grass_field': "no transform from 'base_link'",
    'agent_crowd': "no transform from 'base_link'",
    'vegetation_scanner': "no transform from 'lidar'",
    'wind_broadcaster': "no transform from 'base_link'",
}
