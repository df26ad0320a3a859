// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "forest/forest.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

struct Ray {
  Vec3 origin{Vec3::Zero()};             ///< world [m]
  Vec3 direction{Vec3(0.0, 0.0, -1.0)};  ///< any length but zero
  double tolerance{
      0.0};  ///< largest distance from the surface of a branch that counts as a hit [m]
};

/// A hit of a ray on a branch.
struct Picked {
  std::uint32_t tree{0};
  int branch{0};
  double along{0.0};         ///< from the base of the branch [m]
  double distance{0.0};      ///< from the ray's origin [m]
  Vec3 point{Vec3::Zero()};  ///< on the axis of the branch, world [m]
};

/// Returns the first branch of one tree that the ray hits. `poses` are in the tree's frame.
std::optional<Picked> pickBranch(const Tree& tree, const std::vector<Pose>& poses, const Ray& ray);

/// Returns the first branch of all trees that the ray hits. `posed` grows and poses a tree.
struct PosedTree {
  std::shared_ptr<const Tree> tree;
  std::vector<Pose> poses;
};
std::optional<Picked> pickTree(const Layout& layout, const terrain::HeightMap& terrain,
                               const Ray& ray,
                               const std::function<PosedTree(std::uint32_t)>& posed);

}  // namespace vegetation_sim::forest
