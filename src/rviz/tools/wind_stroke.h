// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::view {

/// A source of wind that is drawn on the ground: it begins at `from`, the stroke gives its
/// direction and, by its length, its speed of 1 m/s per metre.
struct WindStroke {
  Vec3 from{Vec3::Zero()}, to{Vec3::Zero()};  ///< world [m]
  double radius{15.0};                        ///< half width of a gust, reach of a tornado [m]
  double duration{20.0};                      ///< of a tornado [s]
  double speed{12.0};                         ///< default for a click [m/s]
};

/// Returns a gust front that starts its width behind the stroke and fades far beyond; a click sends
/// it east. It begins when all subscribers can have it.
wind::Primitive gustOf(const WindStroke& stroke, Nanoseconds now);
/// Returns a tornado that moves along the stroke within its duration.
wind::Primitive tornadoOf(const WindStroke& stroke, Nanoseconds now);

}  // namespace vegetation_sim::view
