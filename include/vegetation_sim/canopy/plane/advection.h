// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// Method of advection: straight backtracing and bilinear interpolation as in Stam 1999, or
/// backtracing by the velocity at the midpoint and Catmull-Rom's cubic interpolation.
enum class Lookup { BILINEAR, CUBIC };

/// Advects semi-Lagrangian: each cell of `out` gets the value of `field` at the place its air came
/// from. Stable for any step; a displacement longer than the square is cut to it. `out` must be
/// another field than the others. @param cells displacement of air of 1 m/s in cells, dt / dx.
void advect(const PlaneField& field, const PlaneField& velocity, double cells, Lookup lookup,
            PlaneField& out);

}  // namespace vegetation_sim::canopy
