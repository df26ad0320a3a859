// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// A leaf, a piece of a ribbon or a face of a mesh at rest in the world: a quadrilateral strip from
/// root to tip.
struct Leaf {
  /// Root of a connected group of leaves, which alone selects the layer (S3-03) [m].
  Vec3 anchor{Vec3::Zero()};
  Vec3 root{Vec3::Zero()}, tip{Vec3::Zero()};  ///< [m]
  Vec3 side{Vec3::Zero()};                     ///< half of the width [m]
  float root_width{0.6F};                      ///< widths of the strip's ends, relative to `side`
  float tip_width{0.6F};
  float shade{0.0F};   ///< mix of colour and colour_young
  float light{1.0F};   ///< share of the daylight; less inside and below (S3-W5)
  bool joined{false};  ///< a triangle (tip_width 0) that shares corners with other faces
  bool lies{false};    ///< was cut off and lies on the ground: neither wind nor bodies move it
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

/// Leaves and rigid faces of a file, scaled to height 1, with the foot at the origin.
struct Form {
  std::vector<Leaf> leaves, rigid;
  double radius{0.0};     ///< radius of the circle about the foot that contains everything
  std::uint64_t hash{0};  ///< hash of the leaves and faces
};

}  // namespace vegetation_sim::canopy
