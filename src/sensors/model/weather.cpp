// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/weather.h"

#include <cmath>
#include <limits>

namespace vegetation_sim::scan {
namespace {

constexpr double LN_50 = 3.912;                     // of the contrast of 2 %, as Koschmieder's rule
constexpr double PER_DB_KM = 2.302585092994046e-4;  // 1 dB/km in 1/m

}  // namespace

void describe(FieldVisitor& v, Weather& w) {
  v.number("fog_visibility", w.fog_visibility, "m", {0.0, 100000.0});
  v.number("rain_rate", w.rain_rate, "mm/h", {0.0, 200.0});
  v.number("rain_returns", w.rain_returns, "", {0.0, 10.0});
}

double fogExtinction(double visibility) {
  return visibility > 0.0 ? LN_50 / visibility : 0.0;
}

double rainExtinction(double rate) {
  return rate > 0.0 ? PER_DB_KM * 1.076 * std::pow(rate, 0.67) : 0.0;
}

Air::Air(const Weather& weather)
    : extinction_(fogExtinction(weather.fog_visibility) + rainExtinction(weather.rain_rate)),
      drops_(weather.rain_returns * rainExtinction(weather.rain_rate)) {}

double Air::transmission(double range) const {
  return isClear() ? 1.0 : std::exp(-2.0 * extinction_ * range);
}

double Air::firstDrop(double share) const {
  return drops_ > 0.0 ? -std::log1p(-share) / drops_ : std::numeric_limits<double>::infinity();
}

}  // namespace vegetation_sim::scan
