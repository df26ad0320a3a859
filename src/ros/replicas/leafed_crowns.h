// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "canopy/crown.h"
#include "ros/replicas/subscribed_forest.h"

namespace vegetation_sim {

/// Crowns of the forest's own trees with leaves of a canopy layout (S3-W2): wood moves by the
/// forest's law and physics, leaves with their wood, and in layers on top. What is held or pushed
/// takes its leaves along.
class LeafedCrowns {
 public:
  struct Crown {
    std::uint32_t tree{0};
    std::uint16_t kind{0};
    std::vector<canopy::Twig> rest;  ///< of each branch
    std::vector<canopy::CrownLeaf> leaves;
    canopy::LeafBox box;
  };

  /// Grows the crowns that a layout of leaves asks for on the trees that there are; those that are
  /// not have none.
  void grow(const canopy::Layout& layout, const forest::ForestReplica& forest);
  /// Grows the crowns again if the layout of the forest has changed. Returns true if it has.
  bool update(const canopy::Layout& layout, const SubscribedForest& forest);
  void clear();

  const std::vector<Crown>& crowns() const { return crowns_; }
  /// Where the crowns are that have leaves.
  std::vector<canopy::LeafBox> boxes() const;
  /// Base of each branch of a crown's tree in the world at a stamp.
  std::vector<Pose> wood(std::size_t crown, const forest::ForestReplica& forest,
                         Nanoseconds stamp) const;

 private:
  std::vector<Crown> crowns_;
  std::vector<forest::Tree> trees_;
  int forests_{0};  // layouts of the forest when the crowns were grown
};

}  // namespace vegetation_sim
