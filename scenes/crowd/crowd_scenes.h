// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "crowd/agents/crowd.h"
#include "crowd/body/motion_style.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {

inline std::shared_ptr<const terrain::HeightMap> flatGround() {
  return std::make_shared<terrain::HeightMap>();
}

/// A plane that rises to the east, `rise` per metre, and is 0 at x = -50 m; 100 m by 100 m.
inline std::shared_ptr<const terrain::HeightMap> risingGround(double rise) {
  terrain::HeightMapLaw law;
  law.resolution = 100.0;
  law.origin = Vec3(-50, -50, 0);
  law.height_max = 100.0 * rise;
  terrain::GreyImage image;
  image.columns = image.rows = 2;
  image.samples = {0, 255, 0, 255};
  return std::make_shared<terrain::HeightMap>(law, image);
}

/// One style of motion, in which people hold both arms to the front.
inline MotionStyles armsToTheFront() {
  ChannelAngles angles{};
  for (int side = 0; side < 2; ++side) angles[indexOf(Channel::SHOULDER, side)] = 0.5 * PI;
  Clip::Keys keys;
  keys.fill(angles);
  return {{"arms to the front", Clip(keys), Clip(keys), Clip(), 4.0}};
}

/// Makes walls around a rectangle.
inline std::vector<Obstacle> room(double x0, double y0, double x1, double y1) {
  return {wallObstacle({x0, y0}, {x1, y0}, 0.1), wallObstacle({x1, y0}, {x1, y1}, 0.1),
          wallObstacle({x1, y1}, {x0, y1}, 0.1), wallObstacle({x0, y1}, {x0, y0}, 0.1)};
}

inline std::uint32_t spawnAt(Crowd& crowd, const Point& from, const Point& goal,
                             double speed = 1.35) {
  Spawn spawn;
  spawn.position = from;
  spawn.heading = arcTangent(goal.y - from.y, goal.x - from.x);
  spawn.speed = speed;
  spawn.wanders = false;
  spawn.has_goal = true;
  spawn.goal = goal;
  return crowd.spawn(spawn);
}

/// Two walkers who approach each other on one line.
inline Crowd headOn(std::uint64_t seed, const CrowdSettings& settings) {
  Crowd out(seed, settings, {-20, 20, -20, 20}, flatGround());
  spawnAt(out, {-5, 0}, {5, 0});
  spawnAt(out, {5, 0}, {-5, 0});
  return out;
}

/// Each walker goes to the far side of a circle.
inline Crowd circle(int count, double radius, std::uint64_t seed, const CrowdSettings& settings) {
  Crowd out(seed, settings, {-40, 40, -40, 40}, flatGround());
  for (int i = 0; i < count; ++i) {
    const SinCos at = sinCosTurns(static_cast<double>(i) / count);
    spawnAt(out, {radius * at.cos, radius * at.sin}, {-radius * at.cos, -radius * at.sin});
  }
  return out;
}

/// Inside a U that is open to the west; the goal is east of it.
//     +------+
//            |
//       w    |   goal
//            |
//     +------+
inline Crowd trap(std::uint64_t seed, double width, const CrowdSettings& settings) {
  Crowd out(seed, settings, {-20, 20, -20, 20}, flatGround());
  const double y = 0.5 * width;
  out.setObstacles({wallObstacle({2, -y}, {2, y}, 0.2), wallObstacle({-2, -y}, {2, -y}, 0.2),
                    wallObstacle({-2, y}, {2, y}, 0.2)});
  const Random random(seed);
  spawnAt(out, {random.uniform(0, -1.0, 1.0), random.uniform(1, 0.6 - y, y - 0.6)}, {8, 0});
  return out;
}

/// Ten walkers go east and ten west in a corridor of 30 m.
inline Crowd corridor(double width, std::uint64_t seed, const CrowdSettings& settings) {
  Crowd out(seed, settings, {-20, 20, -20, 20}, flatGround());
  const double y = 0.5 * width;
  out.setObstacles({wallObstacle({-60, -y - 0.05}, {60, -y - 0.05}, 0.1),
                    wallObstacle({-60, y + 0.05}, {60, y + 0.05}, 0.1)});
  const Random random(seed);
  for (int i = 0; i < 20; ++i) {
    const auto k = static_cast<std::uint64_t>(2 * i);
    const double east = i % 2 == 0 ? 1.0 : -1.0, across = random.uniform(k, 0.35 - y, y - 0.35);
    const double x = -15.0 * east + east * (i / 2) * 1.2;
    spawnAt(out, {x, across}, {58.0 * east, across});
  }
  return out;
}

/// Ten wandering walkers in a room of 10 m.
inline Crowd crowdedRoom(std::uint64_t seed, const CrowdSettings& settings,
                         const std::shared_ptr<const terrain::HeightMap>& ground = flatGround()) {
  Crowd out(seed, settings, {-4.5, 4.5, -4.5, 4.5}, ground);
  out.setObstacles(room(-5, -5, 5, 5));
  for (int i = 0; i < 10; ++i) {
    Spawn spawn;
    spawn.position = {-4.0 + 0.8 * i, (i % 3) * 1.5 - 1.5};
    spawn.heading = 0.6 * i - 3.0;
    out.spawn(spawn);
  }
  return out;
}

/// Wandering walkers in a square of ten by ten rooms; each wall between two rooms has a door of 2
/// m.
inline Crowd houseOfRooms(int walkers, double side, std::uint64_t seed) {
  constexpr int ROOMS = 10;
  constexpr double DOOR = 2.0, THICK = 0.2;
  Crowd out(seed, CrowdSettings(), {0, side, 0, side}, flatGround());
  const Random random(seed);
  std::uint64_t draw = 0;
  const double room = side / ROOMS;
  std::vector<Obstacle> walls;
  for (int line = 0; line <= ROOMS; ++line) {
    const double x = room * line;
    for (int i = 0; i < ROOMS; ++i) {
      const double y = room * i, end = y + room;
      const bool outside = line == 0 || line == ROOMS;
      const double door = random.uniform(draw++, y + 1.0, end - DOOR - 1.0);
      for (const auto& [from, to] :
           {std::pair(y, outside ? end : door), std::pair(outside ? end : door + DOOR, end)}) {
        if (from == to) continue;
        walls.push_back(wallObstacle({x, from}, {x, to}, THICK));
        walls.push_back(wallObstacle({from, x}, {to, x}, THICK));
      }
    }
  }
  out.setObstacles(std::move(walls));
  for (int i = 0; i < walkers; ++i) {
    Spawn spawn;
    spawn.position.x = random.uniform(draw++, 0.5, side - 0.5);
    spawn.position.y = random.uniform(draw++, 0.5, side - 0.5);
    spawn.heading = random.uniform(draw++, -PI, PI);
    out.spawn(spawn);
  }
  return out;
}

/// Steps for `seconds` and calls `look` with the crowd after each step.
template <class Look>
void run(Crowd& crowd, double seconds, double dt, Look look) {
  const Nanoseconds start = crowd.snapshot().stamp;
  const auto steps = static_cast<std::int64_t>(seconds / dt + 0.5);
  crowd.advance(start == 0 ? NANOSECONDS_PER_SECOND : start);
  const Nanoseconds from = crowd.snapshot().stamp;
  for (std::int64_t i = 1; i <= steps; ++i) {
    crowd.advance(from + fromSeconds(dt * static_cast<double>(i)));
    look(crowd);
  }
}
inline void run(Crowd& crowd, double seconds, double dt) {
  run(crowd, seconds, dt, [](const Crowd&) {});
}

inline bool allArrived(const Crowd& crowd) {
  for (const Walker& w : crowd.walkers())
    if (!w.arrived) return false;
  return true;
}

}  // namespace vegetation_sim::crowd
