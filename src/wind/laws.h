// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::wind {

/// Returns the share of full strength at horizontal (blast: spatial) distance `d` [m] of the
/// centre.
double envelope(const Term& term, double d);

/// Returns the wind velocity [m/s] of one bounded primitive at a position [m], world.
Vec3 velocityOf(const Term& term, const Vec3& position);

/// Returns a bound on the speed [m/s] within `reach` [m] horizontally of `position`, at any height.
/// It follows the term's cycle, not its momentary sine; a gust counts where it is within one
/// second.
double boundOf(const Term& term, const Vec3& position, double reach);

}  // namespace vegetation_sim::wind
