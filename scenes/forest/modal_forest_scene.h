// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {

inline wind::Field breeze() {
  return wind::Field({makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3);
}

/// Four oaks, the first with so many branches or a few more.
inline Layout fourOaks(std::size_t branches) {
  Layout out = gridLayout(2, 12.0);
  const Species plain = shippedSpecies("oak");
  Design design;
  std::size_t grown = 0;
  for (design.children = 0.3; grown < branches; design.children *= 1.02) {
    out.species = {applyDesign(plain, design)};
    for (TreeSeed& seed : out.trees) seed.species = 0;
    grown = grow(out.trees[0], out.species[0]).branches.size();
  }
  return out;
}

/// Four trees in a breeze, and a sensor that comes and goes.
struct Clearing {
  static constexpr double PIXELS_PER_METRE = 170.0;
  explicit Clearing(const wind::Field& field = breeze(), double tolerance = Settings().tolerance) {
    forest.setWind(field);
    look(true);
    tolerate(tolerance);
  }
  void use() { forest.setSettings(settings); }
  /// @param error of trees near the sensor [1/PIXELS_PER_METRE m].
  void tolerate(double error) {
    settings.tolerance = error;
    sensor.tolerance = error / PIXELS_PER_METRE;
    use();
  }
  void publishAtMost(double bytes) {
    settings.budget.state_bytes = bytes;
    use();
  }
  void look(bool near) {
    sensor.id = "sensor";
    sensor.range = 30.0;
    sensor.position = near ? Vec3(6.0, 6.0, 3.0) : Vec3(4000.0, 0.0, 3.0);
  }
  /// Makes the world as fine as the sensor requires, by a body high above the trees.
  void requireOfTheWorld() {
    settings.robot_range = 60.0;
    settings.robot_tolerance = sensor.tolerance;
    use();
    Body body;
    body.id = "crane";
    body.pose.position = Vec3(6.0, 6.0, 40.0);
    body.stamp = now();
    forest.setBody(body);
  }
  /// Sends the inputs that are not part of updates.
  void introduce(ForestReplica& replica) const {
    replica.setLayout(forest.layout(), flatTerrain());
    replica.setWind(forest.snapshot().wind);
  }
  Nanoseconds now() const { return grid.timeOf(tick); }
  void advance() {
    sensor.stamp = grid.timeOf(++tick);
    forest.setSensor(sensor);
    forest.advance(now());
  }
  void run(double duration) {
    for (int i = 0; i < static_cast<int>(duration * TICK_RATE + 0.5); ++i) advance();
  }
  Tree tree(std::uint32_t id) const { return growTree(forest.layout(), id, forest.terrain()); }
  std::vector<JointAngles> angles(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
    std::vector<JointAngles> out =
        modalAngles(tree, forest.snapshot().wind.at(stamp).relativeTo(tree.foot),
                    weightsAt(forest.sensed().levels.of(id), stamp, forest.layout().motion),
                    forest.sensed().modes.find(id), stamp);
    overlay(forest.promoted(id), stamp, out);
    return out;
  }

  Forest forest{gridLayout(2, 12.0), flatTerrain(), Settings()};
  Settings settings;
  Sensor sensor;
  TickGrid grid{TICK_RATE};
  std::int64_t tick{TickGrid(TICK_RATE).tickAt(PHYSICS_START)};
};

}  // namespace vegetation_sim::forest
