// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "canopy/crown.h"
#include "ros/replicas/subscribed_forest.h"

namespace vegetation_sim {

/// Crowns of the trees of a forest with leaves of a canopy layout: the wood moves as in the forest,
/// each leaf moves with its branch, and the motion of its layer is added.
class LeafedCrowns {
 public:
  struct Crown {
    std::uint32_t tree{0};
    std::uint16_t kind{0};
    std::vector<canopy::Twig> rest;  ///< of each branch
    std::vector<canopy::CrownLeaf> leaves;
    canopy::LeafBox box;
    forest::BrokenBranches broken;  ///< what had come off the tree
  };

  /// Grows the crowns of a layout. Trees that the forest does not have are left out.
  void grow(const canopy::Layout& layout, const forest::ForestReplica& forest);
  /// Grows the crowns again if the layout of the forest has changed, or those whose trees have lost
  /// branches. Returns true if so.
  bool update(const canopy::Layout& layout, const SubscribedForest& forest);
  /// Grows the crowns again whose trees have lost branches. Returns true if there are any.
  bool regrowBroken(const canopy::Layout& layout, const forest::ForestReplica& forest);
  void clear();

  const std::vector<Crown>& crowns() const { return crowns_; }
  /// Returns the boxes of the crowns that have leaves.
  std::vector<canopy::LeafBox> boxes() const;
  /// Returns the base of each branch of a crown's tree in the world at a stamp.
  std::vector<Pose> wood(std::size_t crown, const forest::ForestReplica& forest,
                         Nanoseconds stamp) const;

 private:
  static Crown growCrown(const canopy::Layout& layout, const forest::ForestReplica& forest,
                         std::uint16_t kind, const forest::Tree& tree, std::uint32_t id);

  std::vector<Crown> crowns_;
  std::vector<forest::Tree> trees_;
  int forests_{0};  // layouts of the forest when the crowns were grown
};

}  // namespace vegetation_sim
