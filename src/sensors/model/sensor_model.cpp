// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/sensor_model.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, SensorModel& m) {
  v.number("noise", m.noise, "m", {0.0, 1.0});
  v.number("noise_proportional", m.noise_proportional, "", {0.0, 0.1});
  describe(v, m.detection);
  describe(v, m.weather);
  describe(v, m.shape);
  v.choice("returns", m.returns, {"strongest", "last", "both"});
  v.number("noise_weak", m.noise_weak, "m", {0.0, 1.0});
}

void check(const SensorModel& m, const std::string& context, Faults& faults) {
  check(m.shape, context, faults);
  if (m.noise_weak > 0.0 && !(m.detection.detection_range > 0.0))
    faults.add(context + "noise_weak = " + std::to_string(m.noise_weak) +
               " m needs a detection_range above 0 m");
}

double deviationOf(const SensorModel& m, double signal, double transmission, double range) {
  const double usual = m.noise + m.noise_proportional * range;
  if (!(m.noise_weak > 0.0)) return usual;
  const double lack = lackOfLight(m.detection, signal, transmission, range);
  return std::max(usual, m.noise_weak * std::sqrt(lack));
}

}  // namespace vegetation_sim::scan
