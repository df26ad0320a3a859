// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// Distance in time of the looks that rates and accelerations are differenced from: motion at
/// w rad/s is told to (w LOOK)^2 / 6.
constexpr Nanoseconds LOOK = NANOSECONDS_PER_SECOND / PHYSICS_RATE;

/// The wind LOOK before a stamp, at it, and LOOK after, world; shared by all trees of a step.
class WindWindow {
 public:
  /// Looks at `stamp`; keeps its memory from call to call.
  void sampleAt(const wind::Field& field, Nanoseconds stamp);
  Nanoseconds stamp() const { return stamp_; }
  const wind::Instant& now() const { return looks_[1]; }
  const std::array<wind::Instant, 3>& looks() const { return looks_; }
  /// All looks have the same modes, only their phases and amplitudes differ.
  bool turnsAlike() const { return turns_alike_; }
  /// Where that is so: how the phase of each mode turns from now to the look before and the one
  /// after.
  const std::array<std::vector<SinCos>, 2>& turns() const { return turns_; }
  /// Air at a position at the looks [m/s], world: now to the bit what the instant says, before and
  /// after within 1e-13 of its size.
  std::array<Vec3, 3> velocities(const Vec3& position) const;

 private:
  Nanoseconds stamp_{0};
  std::array<wind::Instant, 3> looks_;
  bool turns_alike_{false};
  std::array<std::vector<SinCos>, 2> turns_;
};

}  // namespace vegetation_sim::forest
