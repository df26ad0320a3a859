// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// How the way back is followed and what is found at its end: straight and bilinear, as in Stam
/// 1999, or by the velocity at half the way and with Catmull and Rom's cubic.
enum class Lookup { BILINEAR, CUBIC };

/// Semi-Lagrangian advection: `out` is, at each cell, the value of `field` where the air there came
/// from. Stable for any step; a way back longer than the square is cut to it.
/// @param cells cells passed in the step by air of 1 m/s, dt / dx. `out` is none of the others.
void advect(const PlaneField& field, const PlaneField& velocity, double cells, Lookup lookup,
            PlaneField& out);

}  // namespace vegetation_sim::canopy
