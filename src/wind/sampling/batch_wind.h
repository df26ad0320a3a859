// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::forest {

/// wind::Term in single precision.
struct FloatTerm {
  wind::Kind kind;
  bool smooth;
  float x, y, z, inverse_radius;
  float vx, vy, vz;                    // amplitude
  float nx, ny;                        // gust, wake: direction
  float rise, plateau, decay, radius;  // rise and decay inverted
  float inverse_core, speed, inflow, updraft;
};

/// wind::Mode in single precision: wave and phase in turns.
struct FloatMode {
  float wx, wy, wz, phase, vx, vy, vz;
};

/// wind::Instant in single precision.
struct FloatWind {
  /// Leaves out the terms that cannot move anything within `reach` [m] (horizontally) of the
  /// origin.
  FloatWind(const wind::Instant& wind, double reach);
  float vx, vy, vz;
  std::vector<FloatMode> modes;
  std::vector<FloatTerm> terms;
};

/// Fills the wind velocities at `places`, in the layout of physics::WindQuery, in single precision
/// and the widest instruction set of the processor. The bits are the same on every instruction set.
void fillWind(const FloatWind& wind, const float* places, float* air, std::size_t blocks);

}  // namespace vegetation_sim::forest
