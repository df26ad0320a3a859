// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// Class of the object that a ray hit, with the numbers of ScanReport.msg.
enum class Label : std::uint16_t {
  NONE,
  GROUND,
  TRUNK,
  BRANCH,
  LEAF,
  GRASS,
  PERSON,
  RAIN,
  FOLIAGE,
  STEM,
  COUNT
};
constexpr std::size_t LABELS = static_cast<std::size_t>(Label::COUNT);

/// Ray from the sensor into the world.
struct Ray {
  /// @param towards unit vector.
  Ray(const Vec3& from, const Vec3& towards)
      : origin(from), direction(towards), inverse(towards.cwiseInverse()) {}
  Vec3 at(double distance) const { return origin + distance * direction; }

  Vec3 origin;     ///< world [m]
  Vec3 direction;  ///< unit
  Vec3 inverse;    ///< 1 / component, infinite for 0
};

/// The nearest hit of a ray so far.
struct Hit {
  double distance{std::numeric_limits<double>::infinity()};  ///< [m]
  Label label{Label::NONE};
  std::uint32_t plant{0};  ///< id of the tree, walker or plant
  int branch{-1};          ///< branch of the tree, limb of the walker, leaf or stem of the plant
  double cosine{0.0};      ///< cosine of the angle between ray and normal
};

}  // namespace vegetation_sim::scan
