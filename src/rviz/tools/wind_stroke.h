// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::view {

/// A source of wind drawn on the ground with the mouse: it begins at `from`, the stroke gives its
/// direction, and its length its speed, 1 m/s per metre.
struct WindStroke {
  Vec3 from{Vec3::Zero()}, to{Vec3::Zero()};  ///< world [m]
  double radius{15.0};                        ///< half width of a gust, reach of a tornado [m]
  double duration{20.0};                      ///< of a tornado [s]
  double speed{12.0};                         ///< of the air, where the stroke does not say [m/s]
};

/// Both begin as soon as everyone can know of them.
/// A gust front that starts its width behind the stroke and dies out far beyond; a mere click sends
/// it eastwards.
wind::Primitive gustOf(const WindStroke& stroke, Nanoseconds now);
/// A whirl that walks along the stroke, from its begin to its end in its duration.
wind::Primitive tornadoOf(const WindStroke& stroke, Nanoseconds now);

}  // namespace vegetation_sim::view
