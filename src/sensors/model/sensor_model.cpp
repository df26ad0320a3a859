// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/sensor_model.h"

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, SensorModel& m) {
  v.number("noise", m.noise, "m", {0.0, 1.0});
  v.number("noise_proportional", m.noise_proportional, "", {0.0, 0.1});
  describe(v, m.detection);
  describe(v, m.weather);
  describe(v, m.shape);
  v.choice("returns", m.returns, {"strongest", "last", "both"});
}

}  // namespace vegetation_sim::scan
