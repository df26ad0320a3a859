// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tree/mesh/geometry_level.h"
#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {

/// The limbs that grow from the trunk, each with all that it carries.
class Boughs {
 public:
  Boughs() = default;
  explicit Boughs(const Skeleton& skeleton);

  std::size_t size() const { return balls_.size(); }
  /// Returns the bough of each branch, -1 for those of the trunk.
  const std::vector<std::int32_t>& ofBranches() const { return of_branches_; }
  /// Returns the distance from a place in the tree's frame to a bough at rest [m].
  double distanceTo(std::size_t bough, const Vec3& place) const;

 private:
  struct Ball {
    Vec3 centre{Vec3::Zero()};
    double radius{0.0};
  };
  std::vector<std::int32_t> of_branches_;
  std::vector<Ball> balls_;  // at rest, without leaves
};

/// Levels of geometry of a tree: of its trunk, and of each bough.
struct TreeLevels {
  int trunk{-1};            ///< -1: none was chosen
  std::vector<int> boughs;  ///< none above that of the trunk; empty: all have that of the trunk
};
bool operator==(const TreeLevels& a, const TreeLevels& b);

/// Distance to the middle of a tree within which its boughs get levels of their own, in units of
/// its reach, and that up to which they keep them. The sides of trees beyond are about equally far.
constexpr double DISTANCE_OF_BOUGHS = 4.0, LAST_DISTANCE_OF_BOUGHS = 5.0;

/// Returns the levels of a tree as it is seen from `eye`: each bough has that of a tree all of
/// which is as far as its nearest part (S1-13). Levels near their borders stay as in `current`.
/// @param foot of the tree, in the frame of `eye`. @param factor on projected sizes (S1-14).
/// @param by_bough whether boughs have levels of their own.
TreeLevels treeLevels(const Skeleton& skeleton, const Boughs& boughs, const Vec3& foot,
                      const Viewpoint& eye, double factor, bool by_bough,
                      const TreeLevels& current);

/// Detail of the parts of a tree.
struct TreeMeshDetail {
  MeshDetail trunk;
  std::vector<MeshDetail> boughs;         ///< empty: that of the trunk
  std::vector<std::int32_t> of_branches;  ///< bough of each branch; may be empty if `boughs` is

  const MeshDetail& of(int branch) const {
    const int bough = boughs.empty() ? -1 : of_branches[static_cast<std::size_t>(branch)];
    return bough < 0 ? trunk : boughs[static_cast<std::size_t>(bough)];
  }
  /// Returns the number of recursion depths of which any part has bark.
  int depths() const;
};
TreeMeshDetail treeMeshDetail(const Boughs& boughs, const TreeLevels& levels);

}  // namespace vegetation_sim::forest
