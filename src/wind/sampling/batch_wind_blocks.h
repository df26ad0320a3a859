// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::forest {

/// What physics::AskAir asks for, in single precision and the widest instruction set of the
/// processor; the same bits on every one.
void fillAir(const FloatWind& wind, const float* places, float* air, std::size_t blocks);

}  // namespace vegetation_sim::forest
