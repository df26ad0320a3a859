// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "vegetation_sim/tree/state/promoted_branches.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::forest {

/// Offsets that listeners add to the angles of joints that have become physical. A promotion starts
/// from the world's pose, from which their pose of finer or coarser detail differs; the difference
/// at the promotion is kept and decays, so that no branch jumps. A value.
class PromotionOffsets {
 public:
  /// Notes the joints of a tree that are held now and were not at the last tick.
  /// @param differences computes, for each branch of the tree, the listeners' angles less the
  /// world's at the stamp of `now`, as if the tree had not been promoted since `before`.
  void update(std::uint32_t tree, const PromotedTree& before, const PromotedTree& now,
              const std::function<std::vector<JointAngles>()>& differences);
  /// Removes what has decayed. @param duration of the decay [s].
  void prune(Nanoseconds stamp, double duration);
  void clear() { offsets_.clear(); }
  /// Writes or reads the offsets. @param trees number of trees of the layout.
  void archive(Archive& a, std::size_t trees);
  /// Adds the offsets of a tree to its physical joints.
  void addTo(std::uint32_t tree, double duration, PromotedTree& promoted) const;

 private:
  struct Offset {
    Nanoseconds since{0};
    JointAngles angles;
  };
  std::map<std::uint32_t, std::map<int, Offset>> offsets_;  // by tree and branch
};

}  // namespace vegetation_sim::forest
