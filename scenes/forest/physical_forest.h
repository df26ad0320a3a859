// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {

/// Oaks of so many branches or a few more, enough of them for `total` branches.
inline Layout oaks(std::size_t branches, std::size_t total) {
  Layout out;
  const Species plain = shippedSpecies("oak");
  TreeSeed seed;
  Design design;
  std::size_t grown = 0;
  for (design.children = 0.3; grown < branches; design.children *= 1.02) {
    out.species = {applyDesign(plain, design)};
    grown = grow(seed, out.species[0]).branches.size();
  }
  for (std::size_t sum = 0; sum < total; sum += grown) {
    const std::size_t i = out.trees.size();
    seed.position = Vec3(15.0 * static_cast<double>(i % 20), 15.0 * static_cast<double>(i / 20), 0);
    out.trees.push_back(seed);
  }
  return out;
}

/// Oaks in a breeze of 24 modes, all branches of which are physical and stay so.
class PhysicalForest {
 public:
  PhysicalForest(std::size_t branches, std::size_t total)
      : forest_(oaks(branches, total), flatTerrain(), Settings()),
        tick_(grid_.tickAt(PHYSICS_START)) {
    PhysicsSettings physics;
    physics.promotion = Promotion::DEPTH;
    physics.influence_tolerance = 1e-6;
    physics.linger = 3600.0;
    physics.most_branches = 1000000;
    forest_.setPhysics(physics);
    wind::Primitive breeze = makeBreeze(1, Vec3(4.0, 2.0, 0.0));
    breeze.turbulence = 0.2;
    forest_.setWind(wind::Field({breeze}));
    forest_.advance(grid_.timeOf(tick_));
    twig_ = static_cast<int>(
                growTree(forest_.layout(), 0, forest_.terrain()).skeleton.branches.size()) -
            1;
    for (std::uint32_t tree = 0; tree < treeCount(); ++tree) {
      Push push;
      push.point = {tree, twig_, 0.0};
      push.until = grid_.timeOf(tick_ + 1);
      forest_.push(push);
      if (tree % TOUCHED_AT_A_TIME == TOUCHED_AT_A_TIME - 1) advance();
    }
    settle();
  }
  std::uint32_t treeCount() const { return forest_.layout().treeCount(); }
  std::size_t branchCount() const { return forest_.physicsFigures().branches; }
  /// Holds a twig of every tree.
  void hold() {
    for (std::uint32_t id = 0; id < treeCount() && id < MOST_HELD; ++id) {
      const Tree tree = growTree(forest_.layout(), id, forest_.terrain());
      const auto twig = static_cast<std::size_t>(twig_);
      Grab grab;
      grab.point = {id, twig_, 0.0};
      grab.target = tree.foot + forest_.pose(tree, id, forest_.snapshot().stamp)[twig].position;
      forest_.addGrab(grab);
    }
    settle();
  }
  /// Lets the fade after promotion end, in which steps cost several times as much, and trees become
  /// calm.
  void settle() {
    for (int i = 0; i < 3 * TICK_RATE; ++i) advance();
  }
  void advance() { forest_.advance(grid_.timeOf(++tick_)); }
  void setThreads(int threads) { forest_.setThreads(threads); }
  std::uint64_t hash() const { return forest_.hash(); }

 private:
  static constexpr int TOUCHED_AT_A_TIME = 200;  // trees
  static constexpr int MOST_HELD = 256;          // trees: there is a limit of grabs

  TickGrid grid_{TICK_RATE};
  Forest forest_;
  std::int64_t tick_;
  int twig_{0};
};

}  // namespace vegetation_sim::forest
