// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::canopy {

/// A straight branch with leaves, along the z axis of its pose.
struct Twig {
  Pose pose;  ///< pose of its base, world
  double length{0.0};
  double share{0.0};  ///< relative share of the crown's leaves
};

/// A leaf on a twig, at rest in the world.
struct CrownLeaf {
  std::uint32_t twig{0};
  Leaf leaf;
};

/// Grows kind.leaves leaves along twigs at rest (S3-W2): a pure function of its arguments; no
/// leaves without twigs. Light is that of a crown about the middle of the twigs.
std::vector<CrownLeaf> growCrown(const PlantKind& kind, std::uint64_t seed,
                                 const std::vector<Twig>& rest);

/// Moves a leaf: its root and orientation follow its twig from rest to now, then its tip follows
/// the layer of its root at rest, by at most REACH of its length.
MovedLeaf carry(const Foliage& foliage, const CrownLeaf& leaf, const Pose& rest, const Pose& now);
constexpr double REACH = 0.6;

}  // namespace vegetation_sim::canopy
