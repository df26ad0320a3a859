// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sensors/geometry/rod.h"
#include "vegetation_sim/forest/forest_replica.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scan {

/// One tree for rays: a rod per branch, and a cloud of leaves around each leafy branch that moves
/// with it.
class PosedTree {
 public:
  /// Grows the tree.
  PosedTree(const forest::ForestReplica& forest, std::uint32_t id);

  /// Moves all branches to `stamp`. @param wind of that stamp.
  void pose(const forest::ForestReplica& forest, Nanoseconds stamp, const wind::Instant& wind);
  /// Does the same if the tree moves or moved last time.
  void follow(const forest::ForestReplica& forest, Nanoseconds stamp, const wind::Instant& wind);

  std::uint32_t id() const { return id_; }
  const Vec3& foot() const { return tree_.foot; }  ///< world [m]
  std::size_t branches() const { return rods_.size(); }
  Box bounds() const { return boxes_.bounds(); }
  const std::vector<Rod>& rods() const { return rods_; }

  void meet(const Ray& ray, Hit& nearest) const;
  void meetBranch(std::size_t branch, const Ray& ray, Hit& nearest) const;

 private:
  /// Cloud around the axis of a leafy branch.
  struct Leaves {
    double radius{0.0};      ///< [m]; 0: none
    double extinction{0.0};  ///< extinction [1/m]
    std::uint32_t key{0};
  };
  void addLeaves(const forest::Species& species);
  void fitBoxes();
  void meetLeaves(std::size_t branch, const Ray& ray, Hit& nearest) const;

  std::uint32_t id_;
  forest::Tree tree_;
  forest::BatchPoser poser_;
  forest::BatchPoses poses_;
  std::vector<Rod> rods_;       ///< world
  std::vector<Leaves> leaves_;  ///< of each branch
  std::vector<Box> items_;
  BoxTree boxes_;
  bool moved_{true};
};

/// Projected area of leaves of random orientation per one-sided area (Ross 1981).
constexpr double LEAF_PROJECTION = 0.5;
/// Reach of leaf clusters from their branch, relative to their edge.
constexpr double LEAF_REACH = 0.6;
/// Edge of the cells of a cloud of leaves [m].
constexpr double LEAF_CELL = 0.03;

}  // namespace vegetation_sim::scan
