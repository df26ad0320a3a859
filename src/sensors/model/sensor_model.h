// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/model/beam_shape.h"
#include "sensors/model/detection.h"
#include "sensors/model/weather.h"

namespace vegetation_sim::scan {

/// Which returns of a beam become points. BOTH: the strongest and the last; if these are the same,
/// the second strongest joins it.
enum class ReturnMode { STRONGEST, LAST, BOTH };

/// How a lidar differs from rays that measure exactly; docs/scan.md states the laws.
struct SensorModel {
  double noise{0.01};              ///< standard deviation of ranges at range 0 [m]
  double noise_proportional{0.0};  ///< its growth with the range
  Detection detection;
  Weather weather;
  BeamShape shape;
  ReturnMode returns{ReturnMode::STRONGEST};
};
void describe(FieldVisitor& visitor, SensorModel& model);

}  // namespace vegetation_sim::scan
