// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::scan {

/// Which echoes a sensor detects.
struct Detection {
  double dropout{0.0};  ///< share of echoes that are lost whatever they are
  /// Range at which half of the echoes of a perpendicular target of reflectance REFERENCE are
  /// detected in clear air [m]; 0: no limit.
  double detection_range{0.0};
};
void describe(FieldVisitor& visitor, Detection& detection);

/// Reflectance of the dark targets of data sheets.
constexpr double REFERENCE = 0.1;

/// Returns the received light of the dark target at the detection range over that of an echo;
/// infinite without light. Requires a detection range. Parameters as below.
double lackOfLight(const Detection& detection, double signal, double transmission, double range);

/// Returns the probability that an echo is detected. With a detection range it is s^4 / (1 + s^4),
/// with the received light over that of the dark target, s = signal transmission / REFERENCE
/// (detection range / range)^2; otherwise it is the transmission; times 1 - dropout in both cases.
/// @param signal reflectance times cosine of incidence, times the part of the beam.
double detectionProbability(const Detection& detection, double signal, double transmission,
                            double range);

}  // namespace vegetation_sim::scan
