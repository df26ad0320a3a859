// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// The pose of a sensor during a sweep, at constant velocity and angular velocity in between.
class SensorPath {
 public:
  /// All rays have the same instant and pose. Not explicit, because a pose is such a path.
  SensorPath(const Pose& pose) : begin_(pose) {}
  /// @param seconds > 0 between both poses. The shorter turn counts.
  SensorPath(const Pose& begin, const Pose& end, double seconds);

  bool moves() const { return seconds_ > 0.0; }
  /// Duration of a full turn of the sensor [s]; 0: all rays have the same instant.
  double seconds() const { return seconds_; }
  const Pose& begin() const { return begin_; }
  /// Returns the pose some time after the beginning.
  Pose at(double time) const;
  /// Returns a place in the sensor's frame at the beginning. @param place in its frame at `time`.
  Vec3 toBegin(double time, const Vec3& place) const;

 private:
  Pose begin_;
  Vec3 way_{Vec3::Zero()};    ///< from begin to end, world [m]
  Vec3 axis_{Vec3::UnitZ()};  ///< of the turn, in the sensor's frame
  double angle_{0.0};         ///< of the turn [rad]
  double seconds_{0.0};
};

}  // namespace vegetation_sim::scan
