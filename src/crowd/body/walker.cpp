// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/walker.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double FARTHEST = 1e5;
constexpr std::size_t MOST_CORNERS = 64;

}  // namespace

void describe(FieldVisitor& v, CrowdSettings& s) {
  v.choice("behaviour", s.behaviour, {"goal", "paper"});
  v.choice("noise", s.noise, {"growing", "printed"});
  v.number("noise_heading", s.noise_heading, "rad", {0.0, 1.5});
  v.number("noise_speed", s.noise_speed, "", {0.0, 1.0});
  v.number("sensor_range", s.sensor_range, "m", {0.5, 20.0});
  v.integer("neighbours", s.neighbours, "", {1, 8});
  v.number("commitment", s.commitment, "s", {0.0, 10.0});
  v.number("handedness", s.handedness, "", {-0.5, 0.5});
  v.number("turn_rate", s.turn_rate, "rad/s", {0.1, 20.0});
  v.number("acceleration", s.acceleration, "m/s^2", {0.1, 50.0});
  v.number("reaction", s.reaction, "s", {0.01, 5.0});
  v.number("clearance", s.clearance, "m", {0.001, 1.0});
  v.number("slowest", s.slowest, "", {0.0, 1.0});
  v.number("push_speed", s.push_speed, "m/s", {0.1, 20.0});
  v.number("field_cell", s.field_cell, "m", {0.05, 5.0});
  v.number("grass_drag", s.grass_drag, "", {0.0, 0.95});
  v.number("pace", s.pace, "", {0.0, 2.0});
  v.number("arrival", s.arrival, "m", {0.05, 10.0});
}

void describe(FieldVisitor& v, Spawn& s) {
  v.number("x", s.position.x, "m", {-FARTHEST, FARTHEST});
  v.number("y", s.position.y, "m", {-FARTHEST, FARTHEST});
  v.number("heading", s.heading, "rad", {-2.0 * PI, 2.0 * PI});
  v.number("radius", s.radius, "m", {0.05, 1.0});
  v.number("height", s.height, "m", {0.3, 2.5});
  v.number("speed", s.speed, "m/s", {0.1, 3.0});
}

void check(const Robot& robot, Faults& faults) {
  FieldChecker checker("robot " + inQuotes(robot.id) + ": ", faults);
  Robot r = robot;
  checker.number("x", r.position.x, "m", {-FARTHEST, FARTHEST});
  checker.number("y", r.position.y, "m", {-FARTHEST, FARTHEST});
  checker.number("yaw", r.yaw, "rad", {-100.0, 100.0});
  checker.number("velocity.x", r.velocity.x, "m/s", {-50.0, 50.0});
  checker.number("velocity.y", r.velocity.y, "m/s", {-50.0, 50.0});
  checker.number("radius", r.radius, "m", {0.01, 20.0});
  if (!r.outline.empty() && (r.outline.size() < 3 || r.outline.size() > MOST_CORNERS))
    faults.add("robot " + inQuotes(r.id) + ": outline has " + std::to_string(r.outline.size()) +
               " corners, allowed are 3 to 64, or none for a disc");
  for (Point& corner : r.outline) {
    checker.number("outline.x", corner.x, "m", {-20.0, 20.0});
    checker.number("outline.y", corner.y, "m", {-20.0, 20.0});
  }
}

Obstacle obstacleOf(const Robot& robot) {
  Obstacle out = robot.outline.empty() ? discObstacle(robot.position, robot.radius)
                                       : outlineObstacle(robot.outline, robot.position, robot.yaw);
  out.velocity = robot.velocity;
  return out;
}

}  // namespace vegetation_sim::crowd
