// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// A C2 path through stamped way points: a natural cubic spline, straight on beyond both ends. With
/// one point it stands still, with none it stays at the origin.
class Trajectory {
 public:
  Trajectory() = default;
  /// @param points have strictly increasing stamps (see check()).
  explicit Trajectory(const std::vector<Waypoint>& points);

  /// Returns the position [m] at a stamp.
  Vec3 at(Nanoseconds stamp) const;
  /// Returns a bound on the horizontal acceleration [m/s^2] between two stamps.
  double accelerationBound(Nanoseconds from, Nanoseconds to) const;

 private:
  double step(std::size_t i) const;
  Vec3 chord(std::size_t i) const;
  Vec3 slopeAtStart(std::size_t i) const;
  Vec3 slopeAtEnd(std::size_t i) const;
  void solve();

  std::vector<Waypoint> points_;
  std::vector<Vec3> bend_;  // second derivative at each point [m/s^2]
};

}  // namespace vegetation_sim::wind
