// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::wind {

/// Points [m] and the wind velocities there [m/s], one array per component. All arrays have room
/// for `count` rounded up to ROOM, and numbers there.
struct WindSamples {
  static constexpr std::size_t ROOM = 16;  ///< two of the widest vectors
  const double *x, *y, *z;
  double *vx, *vy, *vz;
  std::size_t count;
};

/// Sums mean and modes of an instant at many points at once, in the widest instruction set of the
/// processor, with the same bits as Instant::velocity without terms.
void sampleBreeze(const Instant& wind, const WindSamples& rows);
/// Does the same for three instants of the same modes at the same points. The first and the last
/// are reached from the middle one by rotating the phases [modes]; these two are off by 1e-15.
void sampleBreeze(const std::array<Instant, 3>& instants,
                  const std::array<std::vector<SinCos>, 2>& turns,
                  const std::array<WindSamples, 3>& rows);

}  // namespace vegetation_sim::wind
