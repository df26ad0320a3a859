// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::forest {

/// Fills the wind velocities at `places`, in the layout of physics::WindQuery, in single precision
/// and the widest instruction set of the processor. The bits are the same on every instruction set.
void fillWind(const FloatWind& wind, const float* places, float* air, std::size_t blocks);

}  // namespace vegetation_sim::forest
