#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes one map for a planner: grass costs what it resists, people and where they will be in a
second are lethal. usage: planner_map.py _full:=100.0 [N/(m/s)]"""
import math

import rospy
from nav_msgs.msg import OccupancyGrid
from vegetation_sim.msg import AgentStates, GrassCover

LETHAL, GRASS = 100, 90  # the highest cost of grass stays below lethal
CLEARANCE = 0.3  # [m] around a person
AHEAD = 1.0  # [s]


class PlannerMap:
    def __init__(self):
        self.full = rospy.get_param('~full', 100.0)  # [N/(m/s)] that costs as much as GRASS
        self.people = []
        self.map = rospy.Publisher('planner_map', OccupancyGrid, queue_size=1, latch=True)
        rospy.Subscriber('agents', AgentStates, self.on_people, queue_size=1)
        rospy.Subscriber('grass/cover/values', GrassCover, self.on_cover, queue_size=1)

    def on_people(self, message):
        self.people = message.agents

    def on_cover(self, cover):
        out = OccupancyGrid(header=cover.header, info=cover.info)
        out.data = [int(GRASS * min(1.0, r / self.full)) for r in cover.resistance]
        for person in self.people:
            for step in range(5):
                t = AHEAD * step / 4
                self.add_disc(out, person.pose.position.x + t * person.velocity.x,
                              person.pose.position.y + t * person.velocity.y,
                              person.radius + CLEARANCE)
        self.map.publish(out)

    @staticmethod
    def add_disc(out, x, y, radius):
        size, origin = out.info.resolution, out.info.origin.position
        x, y, reach = (x - origin.x) / size, (y - origin.y) / size, radius / size
        for row in range(max(0, int(y - reach)), min(out.info.height, int(y + reach) + 1)):
            for column in range(max(0, int(x - reach)), min(out.info.width, int(x + reach) + 1)):
                if math.hypot(column + 0.5 - x, row + 0.5 - y) <= reach:
                    out.data[row * out.info.width + column] = LETHAL


if __name__ == '__main__':
    rospy.init_node('planner_map')
    PlannerMap()
    rospy.spin()
