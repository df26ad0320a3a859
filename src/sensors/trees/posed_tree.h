// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "forest/falling_piece.h"
#include "sensors/media/light_path.h"
#include "sensors/traversal/rod_tree.h"
#include "tree/mesh/paint.h"
#include "vegetation_sim/forest/forest_replica.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scan {

/// A branch with the leaves around its axis, together in memory since a ray needs all of it.
struct alignas(64) PosedBranch {
  Rod rod;    ///< world
  Quat turn;  ///< of the rod
  /// Room that the leaves take around the axis [m]; 0 without leaves.
  double leaf_radius{0.0};
  double extinction{0.0};     ///< of the leaves [1/m]
  std::uint32_t leaf_key{0};  ///< of the random numbers of the leaves
  bool trunk{false}, gone{false};
};
static_assert(sizeof(PosedBranch) == 128, "two cache lines");

/// One tree for rays: a rod per branch, and a cloud of leaves around each leafy branch that moves
/// with it.
class PosedTree {
 public:
  /// Grows the tree.
  PosedTree(const forest::ForestReplica& forest, std::uint32_t id);
  /// A piece that has come off a tree. @param id see Trees.
  PosedTree(const forest::ForestReplica& forest, std::uint32_t id,
            std::shared_ptr<const forest::FallingPiece> piece);

  /// Moves the branches to `stamp` if they move or moved last time. @param wind of that stamp.
  /// @param origin place near the sensor to which rodTree() is fitted [m].
  void follow(const forest::ForestReplica& forest, Nanoseconds stamp, const wind::Instant& wind,
              const Vec3& origin);

  /// Returns whether the tree has lost branches since it was grown.
  bool isOutdated(const forest::ForestReplica& forest) const {
    return !(broken_ == brokenOf(forest.broken(), id_));
  }
  /// Returns whether it is the piece of a record.
  bool isPiece(const forest::BrokenBranch& record) const {
    return piece_ && piece_->record() == record;
  }

  /// Returns whether a piece may be in a ball at a stamp.
  bool isNear(Nanoseconds stamp, const Vec3& centre, double radius) const;

  std::uint32_t id() const { return id_; }
  const Vec3& foot() const { return tree_.foot; }  ///< world [m]
  /// Unlit colours of bark and leaves.
  const forest::TreePaint& paint() const { return paint_; }
  /// Number of branches, which are those of the piece alone if it is one.
  std::size_t parts() const { return branches_.size(); }
  Box bounds() const { return rod_tree_.bounds(); }
  /// Returns the branches with the room for their leaves.
  const RodTree& rodTree() const { return rod_tree_; }
  /// Returns the branches. [parts()]
  const std::vector<PosedBranch>& branches() const { return branches_; }
  /// Returns the index in the tree of a branch, counted from 0 to parts(), and the other way round.
  int branchOf(std::size_t part) const {
    return piece_ ? piece_->branches()[part] : static_cast<int>(part);
  }
  std::size_t partOf(int branch) const;

  /// Replaces the hit by a nearer one on a branch or its leaves; returns whether there is one.
  /// @param wood whether the ray may hit the branch, not only its leaves.
  bool meetBranch(std::size_t branch, const Ray& ray, Hit& nearest, bool wood = true) const;

  /// Adds the optical depth of the leaves of a branch up to the end of the path, or blocks it if
  /// the branch does.
  void addBranchDepth(std::size_t branch, const Ray& ray, LightPath& path, bool wood = true) const;

 private:
  PosedTree(const forest::ForestReplica& forest, std::uint32_t id, forest::Tree tree,
            std::shared_ptr<const forest::FallingPiece> piece);
  void posePiece(Nanoseconds stamp);
  void fit(bool moved, const Vec3& origin);
  RoomyRod roomyRod(std::size_t branch) const {
    return {branches_[branch].rod, branches_[branch].leaf_radius};
  }
  void addLeaves(const forest::Species& species);
  void pose(const forest::ForestReplica& forest, Nanoseconds stamp, const wind::Instant& wind);
  void placeRods();
  bool meetLeaves(std::size_t branch, const Ray& ray, Hit& nearest) const;

  std::uint32_t id_;
  forest::BrokenBranches broken_;
  std::shared_ptr<const forest::FallingPiece> piece_;  ///< null: a tree
  forest::Tree tree_;
  forest::TreePaint paint_;
  forest::BatchPoser poser_;
  forest::BatchPoses poses_;
  std::vector<PosedBranch> branches_;
  RodTree rod_tree_;
  Vec3 origin_;                 ///< of rod_tree_
  double largest_leaves_{0.0};  ///< largest leaf_radius [m]
  bool moved_{true};
};

/// Projected area of leaves of random orientation per one-sided area (Ross 1981).
constexpr double LEAF_PROJECTION = 0.5;
/// Reach of leaf clusters from their branch, relative to their edge.
constexpr double LEAF_REACH = 0.6;
/// Mean cosine between a ray and the normals of leaves of random orientation.
constexpr double LEAF_COSINE = 0.5;
/// Edge of the cells of a cloud of leaves [m].
constexpr double LEAF_CELL = 0.03;

}  // namespace vegetation_sim::scan
