// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/sampling/batch_wind.h"

#include <cmath>

#include "wind/laws.h"

namespace vegetation_sim::forest {
namespace {

float narrow(double x) {
  return static_cast<float>(x);
}

FloatTerm narrowed(const wind::Term& t) {
  FloatTerm out{};
  out.kind = t.kind;
  out.smooth = t.smooth;
  out.x = narrow(t.centre.x());
  out.y = narrow(t.centre.y());
  out.z = narrow(t.centre.z());
  out.inverse_radius = narrow(1.0 / t.radius);
  out.radius = narrow(t.radius);
  out.vx = narrow(t.amplitude.x());
  out.vy = narrow(t.amplitude.y());
  out.vz = narrow(t.amplitude.z());
  out.nx = narrow(t.direction.x());
  out.ny = narrow(t.direction.y());
  out.rise = narrow(1.0 / t.rise);
  out.plateau = narrow(t.plateau);
  out.decay = narrow(1.0 / t.decay);
  out.inverse_core = narrow(1.0 / t.core);
  out.speed = narrow(t.speed);
  out.inflow = narrow(t.inflow);
  out.updraft = narrow(t.updraft);
  return out;
}

// Returns whether the term is exactly zero everywhere within `reach` of the origin.
bool isAbsent(const wind::Term& t, double reach) {
  const double x = -t.centre.x(), y = -t.centre.y();
  if (!wind::hasStrip(t.kind)) return std::sqrt(x * x + y * y) > t.radius + reach;
  const double behind = -(x * t.direction.x() + y * t.direction.y());
  const double beside = y * t.direction.x() - x * t.direction.y();
  const wind::Strip strip = stripOf(t);
  return std::fabs(beside) > strip.side + reach || behind < -strip.ahead - reach ||
         behind > strip.behind + reach;
}

}  // namespace

FloatWind::FloatWind(const wind::Instant& wind, double reach)
    : vx(narrow(wind.mean.x())), vy(narrow(wind.mean.y())), vz(narrow(wind.mean.z())) {
  modes.reserve(wind.modes.size());
  for (const wind::Mode& m : wind.modes)
    modes.push_back({narrow(m.wave.x()), narrow(m.wave.y()), narrow(m.wave.z()), narrow(m.phase),
                     narrow(m.amplitude.x()), narrow(m.amplitude.y()), narrow(m.amplitude.z())});
  terms.reserve(wind.terms.size());
  for (const wind::Term& t : wind.terms)
    if (!isAbsent(t, reach)) terms.push_back(narrowed(t));
}

}  // namespace vegetation_sim::forest
