// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/media/light_path.h"
#include "sensors/traversal/rod_tree_set.h"
#include "sensors/trees/posed_tree.h"

namespace vegetation_sim::scan {

/// The trees of a forest around a sensor, which stay grown while they are within its range.
class Trees {
 public:
  /// @param most_branches limit for all trees but at least one tree; the farthest trees are left
  /// out.
  explicit Trees(std::size_t most_branches = 400000) : most_branches_(most_branches) {}

  /// Poses the trees that reach into a ball at a stamp, and the pieces that have come off trees,
  /// whose ids follow those of the trees in the order in which they came off. Growing new pieces
  /// takes at most as long as growing trees up to the limit, so that many pieces at once appear in
  /// the course of several updates. Requires forest.ready().
  void update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
              Nanoseconds stamp, ThreadPool& threads);
  /// Does the same in the calling thread.
  void update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
              Nanoseconds stamp);
  void clear() { *this = Trees(most_branches_); }

  /// Replaces `nearest` by a nearer hit on wood or leaves. Of hits at equal distances that on the
  /// tree that comes first in all(), there on the branch of the lowest index, counts.
  void meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const;
  /// Does the same for all rays of a bundle, with one hit for each.
  void meet(const RayBundle& bundle, Hit* nearest) const;
  void meet(const Ray& ray, Hit& nearest) const { meet(ray, FloatRay(ray), nearest); }

  /// Adds the optical depth of leaves to a path of light, or blocks it if there is wood.
  void addDepth(const Ray& ray, const FloatRay& narrow, LightPath& path) const;

  const std::vector<std::shared_ptr<PosedTree>>& all() const { return trees_; }
  std::size_t branches() const { return branches_; }
  /// Returns the place near the sensor to which all are fitted [m].
  const Vec3& origin() const { return origin_; }
  /// Returns the number of trees and pieces that exceeded the limit in the last update(), or wait
  /// to be grown.
  std::size_t leftOut() const { return left_out_; }
  /// Returns the number of trees and pieces grown so far.
  std::uint64_t grown() const { return grown_; }

 private:
  using Known = std::map<std::uint32_t, std::shared_ptr<PosedTree>>;
  /// A piece that may come near.
  struct Piece {
    forest::BrokenBranch record;
    std::shared_ptr<PosedTree> tree;  ///< null before it is grown, and while it exceeds the limit
    std::size_t parts{0};             ///< number of its branches; 0 before it was grown
  };
  using Pieces = std::map<std::pair<std::uint32_t, std::size_t>, Piece>;  // by tree and number
  void addPieces(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                 Nanoseconds stamp);
  bool hasRoom(const Piece& piece) const { return fits(std::max<std::size_t>(piece.parts, 1)); }
  bool fits(std::size_t more) const { return branches_ + more <= most_branches_; }

  std::size_t most_branches_;
  std::uint64_t layout_hash_{0};
  std::vector<std::shared_ptr<PosedTree>> trees_;  ///< nearest first
  std::vector<std::uint64_t> first_ranks_;         ///< of the branches of each tree
  std::vector<const PosedBranch*> branches_of_;    ///< the first of each tree
  RodTreeSet rods_;                                ///< of trees_
  std::map<std::uint32_t, std::size_t> sizes_;     ///< branches of trees that exceeded the limit
  Pieces pieces_;
  Vec3 origin_{Vec3::Zero()};
  std::size_t branches_{0}, left_out_{0};
  std::uint64_t grown_{0};
};

}  // namespace vegetation_sim::scan
