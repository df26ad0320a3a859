// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// Axis-aligned box [m]; empty at first.
struct Box {
  static constexpr double ENDLESS = std::numeric_limits<double>::infinity();
  Vec3 low{Vec3::Constant(ENDLESS)}, high{Vec3::Constant(-ENDLESS)};

  bool isEmpty() const { return !(low.x() <= high.x()); }
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  /// Adds a ball.
  void add(const Vec3& centre, double radius) {
    low = low.cwiseMin(Vec3(centre.array() - radius));
    high = high.cwiseMax(Vec3(centre.array() + radius));
  }
};

}  // namespace vegetation_sim::scan
