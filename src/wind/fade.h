// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// Returns a C2 ramp from 0 to 1 over `duration` [s] from `elapsed` = 0, or a step if the duration
/// is 0.
inline double ramp(double elapsed, double duration) {
  if (duration > 0.0) return smootherStep(elapsed / duration);
  return elapsed >= 0.0 ? 1.0 : 0.0;
}

/// Returns the weight of a primitive at a stamp, 0 to 1. A fade out and a fade in of equal length
/// that run at the same time add up to 1, so replacing a primitive by an equal one changes nothing.
inline double fade(const Primitive& p, Nanoseconds stamp) {
  if (stamp < p.t_on || (p.t_off != 0 && stamp >= p.t_off)) return 0.0;
  const double in = ramp(secondsBetween(p.t_on, stamp), p.fade_in);
  return p.t_off == 0 ? in : in * ramp(secondsBetween(stamp, p.t_off), p.fade_out);
}

}  // namespace vegetation_sim::wind
