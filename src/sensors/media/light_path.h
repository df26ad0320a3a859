// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/ray.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {

/// Light on its way along a ray through media, up to an end.
class LightPath {
 public:
  /// @param reach distance of the end [m]. @param dark optical depth from which light counts as
  /// blocked.
  explicit LightPath(double reach, double dark = DARK) : dark_(dark) { end_.distance = reach; }

  /// Adds the optical depth of a medium.
  void add(double depth) {
    depth_ += depth;
    if (depth_ > dark_) block();
  }
  void block() { end_.distance = BLOCKED; }
  bool isBlocked() const { return end_.distance < 0.0; }
  /// Returns the end of the ray, which is behind its origin once the light is blocked, so that a
  /// search for nearer objects ends.
  const Hit& end() const { return end_; }
  /// Returns the share of light that passes: exp(-depth) (Beer-Lambert law).
  double transmittance() const { return isBlocked() ? 0.0 : exponential(-depth_); }

  static constexpr double DARK = 10.0;  ///< 5e-5 of the light is left

 private:
  static constexpr double BLOCKED = -1.0;
  Hit end_;
  double dark_, depth_{0.0};
};

}  // namespace vegetation_sim::scan
