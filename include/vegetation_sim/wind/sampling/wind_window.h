// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// Time between the instants that rates and accelerations are differenced from. The relative error
/// of motion at w rad/s is (w WINDOW_STEP)^2 / 6.
constexpr Nanoseconds WINDOW_STEP = NANOSECONDS_PER_SECOND / PHYSICS_RATE;

/// The wind WINDOW_STEP before a stamp, at it, and WINDOW_STEP after it, world; shared by all trees
/// of a step.
class WindWindow {
 public:
  /// Samples the field at `stamp`; keeps its memory from call to call.
  void sampleAt(const wind::Field& field, Nanoseconds stamp);
  Nanoseconds stamp() const { return stamp_; }
  const wind::Instant& now() const { return instants_[1]; }
  const std::array<wind::Instant, 3>& instants() const { return instants_; }
  /// Returns whether all instants have the same modes, so that only phases and amplitudes differ.
  bool hasSameModes() const { return same_modes_; }
  /// Returns, for hasSameModes(), how the phase of each mode turns from the middle instant to the
  /// one before and the one after.
  const std::array<std::vector<SinCos>, 2>& turns() const { return turns_; }
  /// Returns the wind velocities at a position at the three instants [m/s], world: the middle one
  /// with the bits of Instant::velocity, the others within 1e-13 of its size.
  std::array<Vec3, 3> velocities(const Vec3& position) const;

 private:
  Nanoseconds stamp_{0};
  std::array<wind::Instant, 3> instants_;
  bool same_modes_{false};
  std::array<std::vector<SinCos>, 2> turns_;
};

}  // namespace vegetation_sim::forest
