// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::wind {

/// Orthonormal axes of a wind: along it, horizontally across it, and upwards of both.
struct WindAxes {
  Vec3 along, across, up;
};

inline WindAxes axesOf(const Vec3& mean, double speed) {
  const Vec3 along = mean / speed;
  const double level = std::sqrt(along.x() * along.x() + along.y() * along.y());
  const Vec3 across =
      level > 1e-9 ? Vec3(-along.y() / level, along.x() / level, 0.0) : Vec3(Vec3::UnitY());
  const Vec3 up(along.y() * across.z() - along.z() * across.y(),
                along.z() * across.x() - along.x() * across.z(),
                along.x() * across.y() - along.y() * across.x());
  return {along, across, up};
}

}  // namespace vegetation_sim::wind
