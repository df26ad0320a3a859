// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_scene.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr Range PLACES{-1e5, 1e5};
constexpr std::size_t MOST_WALLS = 10000;

Point readPoint(YamlSection& section, const char* name) {
  Vec3 out = Vec3::Zero();
  section.vector(name, out, "m", PLACES);
  return {out.x(), out.y()};
}

Wall readWall(YamlSection& section) {
  Wall out;
  if (!section.has("from") || !section.has("to")) section.fault("needs from and to");
  out.from = readPoint(section, "from");
  out.to = readPoint(section, "to");
  section.number("thickness", out.thickness, "m", {0.0, 10.0});
  section.finish();
  return out;
}

Spawn readWalker(YamlSection& section) {
  Spawn out;
  describe(section, out);
  out.has_goal = section.has("goal");
  if (out.has_goal) out.goal = readPoint(section, "goal");
  out.wanders = !out.has_goal;
  section.flag("wanders", out.wanders);
  section.finish();
  return out;
}

// Limits fields to their ranges.
class Limiter : public FieldVisitor {
 public:
  void number(const char* /*name*/, double& value, const char* /*unit*/, Range range) override {
    value = std::min(range.high, std::max(range.low, value));
  }
  void integer(const char* /*name*/, int& /*value*/, const char* /*unit*/,
               Range /*range*/) override {}
  void vector(const char* /*name*/, Vec3& /*value*/, const char* /*unit*/,
              Range /*range*/) override {}
  void choice(const char* /*name*/, int& /*value*/,
              const std::vector<std::string>& /*names*/) override {}
};

void readGroup(YamlSection& section, const Random& random, std::vector<Spawn>& out) {
  Spawn like;
  describe(section, like);
  int count = 1;
  double spread = 3.0, variety = 0.12;
  section.integer("count", count, "", {1, static_cast<double>(MOST_WALKERS)});
  section.number("spread", spread, "m", {0.0, 1e4});
  section.number("variety", variety, "", {0.0, 0.3});
  like.has_goal = section.has("goal");
  like.wanders = !like.has_goal;
  if (like.has_goal) like.goal = readPoint(section, "goal");
  section.finish();
  count = std::min(count, static_cast<int>(MOST_WALKERS - std::min(MOST_WALKERS, out.size())));
  for (const Spawn& one : groupOf(like, count, spread, variety, random)) out.push_back(one);
}

}  // namespace

std::vector<Spawn> groupOf(const Spawn& like, int count, double spread, double variety,
                           const Random& random) {
  std::vector<Spawn> out;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint64_t>(5 * i);
    Spawn one = like;
    one.position = like.position + Point{random.uniform(k, -spread, spread),
                                         random.uniform(k + 1, -spread, spread)};
    one.heading = random.uniform(k + 2, -PI, PI);
    one.speed *= 1.0 + random.uniform(k + 3, -variety, variety);
    one.height *= 1.0 + 0.6 * random.uniform(k + 4, -variety, variety);
    Limiter limiter;
    describe(limiter, one);
    out.push_back(one);
  }
  return out;
}

Scene readScene(YamlSection& section, std::uint64_t seed, Faults& faults) {
  Scene out;
  describe(section, out.settings);
  YamlSection area = section.section("area");
  describe(area, out.area);
  area.finish();
  if (!(out.area.min_x <= out.area.max_x && out.area.min_y <= out.area.max_y))
    section.fault("area", "holds no place: its least x and y should be below its largest");
  for (YamlSection& wall : section.sections("walls")) out.walls.push_back(readWall(wall));
  for (YamlSection& walker : section.sections("walkers")) out.spawns.push_back(readWalker(walker));
  const Random random(seed);
  std::uint64_t group = 0;
  for (YamlSection& entry : section.sections("groups"))
    readGroup(entry, random.child(group++), out.spawns);
  if (out.walls.size() > MOST_WALLS)
    faults.add(section.path() + ": walls = " + std::to_string(out.walls.size()) + ", allowed are " +
               std::to_string(MOST_WALLS));
  return out;
}

std::vector<Obstacle> obstaclesOf(const std::vector<Wall>& walls) {
  std::vector<Obstacle> out;
  out.reserve(walls.size());
  for (const Wall& wall : walls) out.push_back(wallObstacle(wall.from, wall.to, wall.thickness));
  return out;
}

}  // namespace vegetation_sim::crowd
