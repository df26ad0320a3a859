// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::canopy {

/// A straight piece of wood that leaves hang on, along the z axis of its pose.
struct Twig {
  Pose pose;  ///< of its base, world
  double length{0.0};
  double share{0.0};  ///< of the crown's leaves, relative to the others
};

/// A leaf on a twig, at rest in the world.
struct CrownLeaf {
  std::uint32_t twig{0};
  Leaf leaf;
};

/// Leaves of a kind, kind.leaves of them, along twigs at rest (S3-W2): a pure function of its
/// arguments, none without twigs. Light is that of a crown about the middle of the twigs.
std::vector<CrownLeaf> growCrown(const PlantKind& kind, std::uint64_t seed,
                                 const std::vector<Twig>& rest);

/// Where the leaf goes: its root and turn with its twig, from rest to now; then its tip with the
/// layer of its root at rest, by at most REACH of its length.
MovedLeaf carry(const Foliage& foliage, const CrownLeaf& leaf, const Pose& rest, const Pose& now);
constexpr double REACH = 0.6;

}  // namespace vegetation_sim::canopy
