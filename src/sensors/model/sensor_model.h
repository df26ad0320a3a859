// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

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
  double noise_weak{0.0};          ///< that of an echo as weak as that of Detection's range [m]
  Detection detection;
  Weather weather;
  BeamShape shape;
  ReturnMode returns{ReturnMode::STRONGEST};
};
void describe(FieldVisitor& visitor, SensorModel& model);
/// Adds the faults of the beam, and one for noise_weak without a detection range.
void check(const SensorModel& model, const std::string& context, Faults& faults);

/// Returns the standard deviation of the range of an echo [m]: the sum of both noises, or that of
/// weak echoes, which is inversely proportional to the root of the received light, if it is larger.
double deviationOf(const SensorModel& model, double signal, double transmission, double range);

}  // namespace vegetation_sim::scan
