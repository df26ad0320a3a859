// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "canopy/crown.h"
#include "sensors/geometry/ranked_hit.h"
#include "sensors/traversal/strip_tree.h"

namespace vegetation_sim::scan {

/// Leaves of a canopy on a tree of the forest. What it points to must outlive its use.
struct CrownSource {
  std::uint32_t tree;
  const std::vector<canopy::CrownLeaf>* leaves;
  const std::vector<canopy::Twig>* rest;    ///< of each branch
  std::function<std::vector<Pose>()> wood;  ///< returns the base of each branch now, world
};

/// One crown for rays: a strip per leaf, which moves with its branch and its layer.
class PosedCrown {
 public:
  explicit PosedCrown(const CrownSource& source);
  /// Requires the leaves of the source that it was made of.
  void pose(const CrownSource& source, const canopy::Foliage& foliage);

  std::uint32_t id() const { return tree_; }
  std::size_t parts() const { return strips_.size(); }
  const Box& bounds() const { return strip_tree_.bounds(); }
  /// Replaces the hit by a nearer one. Parts have the ranks from `first_rank` on.
  void meet(const Ray& ray, const FloatRay& narrow, std::uint64_t first_rank,
            RankedHit& nearest) const;
  /// Does the same without ranks for one leaf; returns whether there is a nearer hit, which is on
  /// a leaf of the branch of the tree.
  bool meetLeaf(std::size_t leaf, const Ray& ray, Hit& nearest) const;

 private:
  std::uint32_t tree_;
  Vec3 origin_;                ///< of strip_tree_ [m]
  std::vector<int> branches_;  ///< of the leaves
  std::vector<Strip> strips_;
  StripTree strip_tree_;
};

}  // namespace vegetation_sim::scan
