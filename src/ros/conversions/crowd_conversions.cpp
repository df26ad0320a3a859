// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/crowd_conversions.h"

#include <cmath>

#include "ros/conversions/optional_numbers.h"
#include "ros/conversions/orientation.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim {
namespace {

constexpr Range PLACES{-1e7, 1e7}, HEIGHTS{0.1, 5.0}, TURN_RATES{-100.0, 100.0};

geometry_msgs::Point pointOf(const crowd::Point& p, double z) {
  return toPoint(Vec3(p.x, p.y, z));
}

geometry_msgs::Vector3 vectorOf(const crowd::Point& p) {
  return toVector(Vec3(p.x, p.y, 0.0));
}

template <class Message>
crowd::Point planOf(const Message& message) {
  return {message.x, message.y};
}

void check(const AgentState& agent, Faults& faults) {
  FieldChecker checker("agent " + std::to_string(agent.id) + ": ", faults);
  const auto place = [&](const char* name, Vec3 at) { checker.vector(name, at, "m", PLACES); };
  place("position", fromMsg(agent.pose.position));
  double height = agent.height, gait = agent.gait;
  double turn_rate = agent.turn_rate;
  checker.number("height", height, "m", HEIGHTS);
  checker.number("turn_rate", turn_rate, "rad/s", TURN_RATES);
  checker.number("gait", gait, "", PLACES);
  Vec3 velocity = fromMsg(agent.velocity);
  checker.vector("velocity", velocity, "m/s", PLACES);
  orientationOf(agent.pose.orientation, "agent " + std::to_string(agent.id) + ": orientation",
                faults);
  for (std::size_t i = 0; i < 2; ++i) {
    place("feet", fromMsg(agent.feet[i]));
    place("feet_lag", fromMsg(agent.feet_lag[i]));
  }
}

}  // namespace

AgentState toMsg(const crowd::Walker& w, const terrain::HeightMap& terrain) {
  AgentState out;
  out.id = w.id;
  out.pose.position = pointOf(w.position, terrain.height(w.position.x, w.position.y));
  const SinCos half = sinCos(0.5 * w.heading);
  out.pose.orientation.z = half.sin;
  out.pose.orientation.w = half.cos;
  out.velocity = vectorOf(w.velocity);
  out.turn_rate = w.turn_rate;
  out.radius = w.radius;
  out.height = w.height;
  out.gait = w.gait;
  for (std::size_t i = 0; i < 2; ++i) {
    const crowd::Point& foot = w.feet[i].planted;
    out.feet[i] = pointOf(foot, terrain.height(foot.x, foot.y));
    out.feet_stand[i] = w.feet[i].stands;
    out.feet_lag[i] = vectorOf(w.feet[i].offset);
  }
  out.has_goal = w.has_goal;
  out.arrived = w.arrived;
  out.goal = pointOf(w.goal, terrain.height(w.goal.x, w.goal.y));
  out.no_progress = w.no_progress;
  return out;
}

crowd::Walker fromMsg(const AgentState& message) {
  crowd::Walker out;
  out.id = message.id;
  out.position = planOf(message.pose.position);
  const auto& q = message.pose.orientation;
  out.heading = 2.0 * arcTangent(q.z, q.w);
  out.velocity = planOf(message.velocity);
  out.turn_rate = message.turn_rate;
  out.radius = message.radius;
  out.height = message.height;
  out.gait = message.gait;
  for (std::size_t i = 0; i < 2; ++i)
    out.feet[i] = {planOf(message.feet[i]), planOf(message.feet_lag[i]),
                   message.feet_stand[i] != 0};
  out.has_goal = message.has_goal;
  out.arrived = message.arrived;
  out.goal = planOf(message.goal);
  out.no_progress = message.no_progress;
  return out;
}

void check(const std::vector<AgentState>& agents) {
  Faults faults;
  for (const AgentState& agent : agents) check(agent, faults);
  faults.throwIfAny();
}

std::vector<WalkerView> peopleOf(const std::vector<AgentState>& agents) {
  check(agents);
  std::vector<WalkerView> out;
  out.reserve(agents.size());
  for (const AgentState& agent : agents) out.push_back({fromMsg(agent), agent.pose.position.z});
  return out;
}

std::vector<InterestDisc> toMsg(const std::vector<InterestArea>& discs) {
  std::vector<InterestDisc> out(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i) {
    out[i].x = discs[i].x;
    out[i].y = discs[i].y;
    out[i].radius = discs[i].radius;
  }
  return out;
}

std::vector<InterestArea> fromMsg(const std::vector<InterestDisc>& discs) {
  if (discs.size() > MOST_DISCS)
    throw InvalidInput("discs has " + std::to_string(discs.size()) + " entries, allowed are " +
                       std::to_string(MOST_DISCS));
  std::vector<InterestArea> out;
  Faults faults;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    FieldChecker checker("discs[" + std::to_string(i) + "].", faults);
    out.push_back({discs[i].x, discs[i].y, discs[i].radius});
    checker.number("x", out.back().x, "m", PLACES);
    checker.number("y", out.back().y, "m", PLACES);
    checker.number("radius", out.back().radius, "m", {0.0, 2e9});
  }
  faults.throwIfAny();
  return out;
}

AgentSpawn toMsg(const crowd::Spawn& spawn) {
  AgentSpawn out;
  out.position = pointOf(spawn.position, 0.0);
  out.heading = spawn.heading;
  out.has_speed = out.has_radius = out.has_height = true;
  out.speed = spawn.speed;
  out.radius = spawn.radius;
  out.height = spawn.height;
  out.has_goal = spawn.has_goal;
  if (spawn.has_goal) out.goal = pointOf(spawn.goal, 0.0);
  out.stands = !spawn.has_goal && !spawn.wanders;
  return out;
}

crowd::Spawn fromMsg(const AgentSpawn& message, const std::string& context, Faults& faults) {
  OptionalNumbers numbers(context, faults);
  crowd::Spawn out;
  out.position = planOf(message.position);
  out.heading = message.heading;
  numbers.read("speed", message.has_speed, message.speed, out.speed);
  numbers.read("radius", message.has_radius, message.radius, out.radius);
  numbers.read("height", message.has_height, message.height, out.height);
  out.has_goal = message.has_goal;
  if (message.has_goal)
    out.goal = planOf(message.goal);
  else if (!(fromMsg(message.goal) == Vec3::Zero()))
    faults.add(context + "goal needs has_goal = true");
  out.wanders = !message.has_goal && !message.stands;
  return out;
}

CrowdRobot toMsg(const crowd::Robot& robot) {
  CrowdRobot out;
  out.id = robot.id;
  for (const crowd::Point& corner : robot.outline) out.outline.push_back(pointOf(corner, 0.0));
  out.radius = robot.radius;
  out.position = pointOf(robot.position, 0.0);
  out.yaw = robot.yaw;
  out.velocity = vectorOf(robot.velocity);
  return out;
}

crowd::Robot fromMsg(const CrowdRobot& message) {
  crowd::Robot out;
  out.id = message.id;
  for (const auto& corner : message.outline) out.outline.push_back(planOf(corner));
  out.radius = message.radius;
  out.position = planOf(message.position);
  out.yaw = message.yaw;
  out.velocity = planOf(message.velocity);
  return out;
}

std::vector<crowd::Obstacle> trunksOf(const forest::Layout& layout, TrunkShape shape,
                                      const crowd::Area& area, double margin, std::size_t most) {
  std::vector<crowd::Obstacle> out;
  const auto add = [&](const forest::TreeSeed& tree) {
    const crowd::Point at{tree.position.x(), tree.position.y()};
    if (out.size() >= most || at.x < area.min_x - margin || at.x > area.max_x + margin ||
        at.y < area.min_y - margin || at.y > area.max_y + margin)
      return;
    const forest::Species& species = layout.species[tree.species];
    const double radius = species.trunk_radius * trunkScale(tree, species);
    out.push_back(shape == TrunkShape::ROUND ? crowd::discObstacle(at, radius)
                                             : crowd::boxObstacle(at, radius, radius, tree.yaw));
  };
  for (const forest::TreeSeed& tree : layout.trees) add(tree);
  // A small message can have millions of trees in tiles.
  const Vec3 centre(0.5 * (area.min_x + area.max_x), 0.5 * (area.min_y + area.max_y), 0.0);
  const double radius =
      std::hypot(area.max_x - centre.x() + margin, area.max_y - centre.y() + margin);
  for (const forest::Tile& tile : layout.tiles) {
    if (out.size() >= most) break;
    for (const std::uint32_t i : findTreesInTile(tile, centre, radius)) add(seedInTile(tile, i));
  }
  return out;
}

std::uint64_t hashOf(const nav_msgs::OccupancyGrid& cover) {
  Hash hash;
  hash.add(std::uint64_t{cover.info.width});
  hash.add(std::uint64_t{cover.info.height});
  hash.add(cover.info.origin.position.x);
  hash.add(cover.info.origin.position.y);
  hash.add(static_cast<double>(cover.info.resolution));
  for (const std::int8_t cell : cover.data) hash.add(static_cast<std::uint64_t>(cell + 1));
  return hash.value();
}

crowd::Resistance resistanceOf(const nav_msgs::OccupancyGrid& cover) {
  const std::size_t width = cover.info.width, height = cover.info.height;
  const double cell = static_cast<double>(cover.info.resolution);
  if (cover.data.size() != width * height || !(cell > 0.0) || width == 0 || height == 0)
    throw InvalidInput("cover: data has " + std::to_string(cover.data.size()) + " cells, width " +
                       std::to_string(width) + " and height " + std::to_string(height) +
                       " want another number, or resolution = " + std::to_string(cell) +
                       " m is not above 0");
  const crowd::Point origin{cover.info.origin.position.x, cover.info.origin.position.y};
  if (!std::isfinite(origin.x) || !std::isfinite(origin.y))
    throw InvalidInput("cover: origin is not finite");
  const auto data = std::make_shared<const std::vector<std::int8_t>>(cover.data);
  return [=](const crowd::Point& place) {
    const double column = (place.x - origin.x) / cell, row = (place.y - origin.y) / cell;
    if (column < 0.0 || row < 0.0 || column >= static_cast<double>(width) ||
        row >= static_cast<double>(height))
      return 0.0;
    const int percent =
        (*data)[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
    return percent < 0 ? 0.0 : 0.01 * percent;
  };
}

}  // namespace vegetation_sim
