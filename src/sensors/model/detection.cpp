// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/detection.h"

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, Detection& d) {
  v.number("dropout", d.dropout, "", {0.0, 1.0});
  v.number("detection_range", d.detection_range, "m", {0.0, 1000.0});
}

double detectionProbability(const Detection& d, double signal, double transmission, double range) {
  double share = transmission;
  if (d.detection_range > 0.0) {
    const double light = signal * transmission * d.detection_range * d.detection_range;
    if (!(light > 0.0)) return 0.0;
    const double lack = REFERENCE * range * range / light;
    share = 1.0 / (1.0 + lack * lack * lack * lack);
  }
  return (1.0 - d.dropout) * share;
}

}  // namespace vegetation_sim::scan
