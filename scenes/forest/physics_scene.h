// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "forest/forest.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/forest/forest_replica.h"

// One tree, or a square of them, in a steady wind; shared by the tests of promotion.

namespace vegetation_sim::forest {

constexpr Nanoseconds PHYSICS_START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int TICK_RATE = 60;

/// Returns a disk that covers everything: uniform wind up to 1 %, `omega` rad/s.
inline wind::Field steadyWind(const Vec3& velocity, double omega = 2.0) {
  wind::Primitive out = makeDisk(1, Vec3::Zero(), 2000.0, velocity);
  out.omega = omega;
  out.epoch = PHYSICS_START;  // phases are exact near it
  return wind::Field({out});
}

struct PhysicsRig {
  Forest forest;
  Tree tree;
  TickGrid grid{TICK_RATE};
  std::int64_t tick{0};

  explicit PhysicsRig(const PhysicsSettings& physics = {}, int side = 1,
                      const char* species = "oak")
      : PhysicsRig(makeLayout(side, species), physics) {}
  explicit PhysicsRig(Layout layout, const PhysicsSettings& physics = {})
      : forest(std::move(layout), flatTerrain(), makeSettings()),
        tree(growTree(forest.layout(), 0, forest.terrain())) {
    forest.setPhysics(physics);
    tick = grid.tickAt(PHYSICS_START);
    forest.advance(now());
  }
  static Layout makeLayout(int side, const char* species) {
    Layout out = gridLayout(side, 12.0);
    out.species = {shippedSpecies(species)};
    for (TreeSeed& seed : out.trees) seed.species = 0;
    return out;
  }
  static Settings makeSettings() {
    Settings out;
    out.fixed_level = MAX_DEPTHS;
    return out;
  }

  Nanoseconds now() const { return grid.timeOf(tick); }
  void advance() { forest.advance(grid.timeOf(++tick)); }
  void run(double duration, const std::function<void()>& each = {}) {
    const auto ticks = static_cast<int>(duration * TICK_RATE + 0.5);
    for (int i = 0; i < ticks; ++i) {
      advance();
      if (each) each();
    }
  }

  const std::vector<Branch>& branches() const { return tree.skeleton.branches; }
  /// Returns the last branch of the first limb of a depth: a twig for the deepest.
  int branchOfDepth(int depth) const {
    int out = tree.skeleton.depth_end[static_cast<std::size_t>(depth)] - 1;
    return out;
  }
  int twig() const { return branchOfDepth(tree.skeleton.depths() - 1); }
  std::vector<JointAngles> procedural(Nanoseconds stamp) const {
    return proceduralAngles(tree, forest.snapshot().wind.at(stamp).relativeTo(tree.foot),
                            weightsAt(forest.world().levels.of(0), stamp, forest.layout().motion));
  }
  /// Returns the displayed angles, physical ones included.
  std::vector<JointAngles> angles(Nanoseconds stamp) const {
    std::vector<JointAngles> out = procedural(stamp);
    overlay(forest.promoted(0), stamp, out);
    return out;
  }
  Vec3 pointOn(const BranchPoint& at) const {
    const Pose pose = forest.pose(tree, at.tree, forest.snapshot().stamp)[at.branch];
    return tree.foot + pose.position + at.along * axisZ(pose.orientation);
  }
  Vec3 tip(int branch) const { return pointOn({0, branch, branches()[branch].length}); }
  Grab grabOf(int branch) const {
    Grab out;
    out.point = {0, branch, branches()[branch].length};
    out.target = pointOn(out.point);
    return out;
  }
  /// Makes a branch physical without any force, for `duration` seconds.
  void touch(int branch, double duration) {
    Push push;
    push.point = {0, branch, 0.0};
    push.until = now() + seconds(duration);
    forest.push(push);
  }
};

inline double difference(const JointAngles& a, const JointAngles& b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

/// Returns the root mean square length.
inline double rms(const std::vector<Vec3>& values) {
  double sum = 0.0;
  for (const Vec3& v : values) sum += dot(v, v);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Returns the displacements of tips from rest [m].
inline std::vector<Vec3> tipsOf(const PhysicsRig& rig) {
  const auto poses = rig.forest.pose(rig.tree, 0, rig.forest.snapshot().stamp);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& b = rig.branches()[i];
    out.push_back(tipOf(b, poses[i]) - tipOf(b, b.rest));
  }
  return out;
}

}  // namespace vegetation_sim::forest
