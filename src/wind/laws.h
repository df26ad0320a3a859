// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::wind {

/// Length over which the momentum of a wake spreads, over the radius of the body.
constexpr double WAKE_SPREAD = 3.0;
/// Distance from its axis at which a wake ends, over its width.
constexpr double WAKE_EDGE = 3.0;
/// Largest speed in a wake over that at the centre of the body: ahead of it, the wake is narrower.
constexpr double WAKE_PEAK = 1.02;

/// Box along the direction of a gust or wake that contains all its wind.
struct Strip {
  double ahead, behind;  ///< distances from the centre [m]
  double side;           ///< half width [m]
};

/// Returns whether the wind of such a primitive lies in a strip rather than around its centre.
inline bool hasStrip(Kind kind) {
  return kind == Kind::GUST || kind == Kind::WAKE;
}

/// Returns the strip of a gust or wake.
Strip stripOf(const Term& term);

/// Returns the share of full strength at horizontal (blast: spatial) distance `d` [m] of the
/// centre.
double envelope(const Term& term, double d);

/// Returns the wind velocity [m/s] of one bounded primitive at a position [m], world.
Vec3 velocityOf(const Term& term, const Vec3& position);

/// Returns a bound on the speed [m/s] within `reach` [m] horizontally of `position`, at any height.
/// It follows the term's cycle, not its momentary sine; a gust or wake counts where it is within
/// one second.
double boundOf(const Term& term, const Vec3& position, double reach);

}  // namespace vegetation_sim::wind
