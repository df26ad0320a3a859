// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// A leaf, a piece of a ribbon or a face of a mesh, at rest in the world: a four-cornered strip
/// from root to tip.
struct Leaf {
  /// Root of what hangs together; it alone chooses the layer (S3-03) [m].
  Vec3 anchor{Vec3::Zero()};
  Vec3 root{Vec3::Zero()}, tip{Vec3::Zero()};  ///< [m]
  Vec3 side{Vec3::Zero()};                     ///< half the width across [m]
  float root_width{0.6F};                      ///< of the strip's ends, over `side`
  float tip_width{0.6F};
  float shade{0.0F};   ///< from colour to colour_young
  float light{1.0F};   ///< share of daylight that gets there: less inside and below (S3-W5)
  bool joined{false};  ///< a triangle, tip_width 0, whose corners other faces share
};

/// A straight rigid part.
struct Stem {
  Vec3 from, to;  ///< [m]
  double radius;  ///< [m]
};

/// A grown plant, in the world.
struct GrownPlant {
  std::vector<Leaf> leaves;
  std::vector<Stem> stems;
  std::vector<Leaf> rigid;  ///< faces that are never displaced (S3-02)
};

/// Leaves and rigid faces that were read, over the plant's height, with the foot at the origin.
struct Form {
  std::vector<Leaf> leaves, rigid;
  double radius{0.0};     ///< of the circle about the foot that holds all of it
  std::uint64_t hash{0};  ///< of everything above
};

}  // namespace vegetation_sim::canopy
