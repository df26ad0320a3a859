// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/detection.h"

#include <limits>

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, Detection& d) {
  v.number("dropout", d.dropout, "", {0.0, 1.0});
  v.number("detection_range", d.detection_range, "m", {0.0, 1000.0});
}

double lackOfLight(const Detection& d, double signal, double transmission, double range) {
  const double light = signal * transmission * d.detection_range * d.detection_range;
  return light > 0.0 ? REFERENCE * range * range / light : std::numeric_limits<double>::infinity();
}

double detectionProbability(const Detection& d, double signal, double transmission, double range) {
  double share = transmission;
  if (d.detection_range > 0.0) {
    const double lack = lackOfLight(d, signal, transmission, range);
    share = 1.0 / (1.0 + lack * lack * lack * lack);
  }
  return (1.0 - d.dropout) * share;
}

}  // namespace vegetation_sim::scan
