// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::wind {

/// Points [m] and their air [m/s], one array a component. All have room for `count` rounded up to
/// ROOM, and numbers there.
struct WindSamples {
  static constexpr std::size_t ROOM = 16;  ///< two of the widest vectors
  const double *x, *y, *z;
  double *vx, *vy, *vz;
  std::size_t count;
};

/// Mean and modes of an instant at many points at once, in the widest instruction set of the
/// processor: to the bit what Instant::velocity gives one by one where there are no terms.
void sampleBreeze(const Instant& wind, const WindSamples& rows);
/// The same of three instants of the same modes at the same points, the first and last of which are
/// reached from the middle one by turns [modes] of the phases. Those two are off by 1e-15.
void sampleBreeze(const std::array<Instant, 3>& looks,
                  const std::array<std::vector<SinCos>, 2>& turns,
                  const std::array<WindSamples, 3>& rows);

}  // namespace vegetation_sim::wind
