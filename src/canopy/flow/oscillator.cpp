// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/oscillator.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

// Limit for spectra, which are size^2 times as large as cells.
constexpr double MOST_MODE_ENERGY = 1e16;
constexpr double MARGIN = 0.95;  // share of Verlet's longest step

WaveLaw lawOf(OscillatorSettings settings, double width) {
  Faults faults;
  FieldChecker checker("oscillator: ", faults);
  describe(checker, settings);
  faults.throwIfAny();
  return {2.0 * PI * settings.frequency, settings.damping, settings.speed, width};
}

double saturated(double wind, double limit) {
  return wind / (1.0 + std::fabs(wind) / limit);
}

}  // namespace

void describe(FieldVisitor& v, OscillatorSettings& s) {
  v.choice("integrator", s.integrator, {"exact", "verlet"});
  v.number("frequency", s.frequency, "Hz", {0.05, 20.0});
  v.number("damping", s.damping, "", {0.0, 50.0});
  v.number("speed", s.speed, "m/s", {0.0, 20.0});
  v.number("limit", s.limit, "m/s", {0.1, 200.0});
}

void OscillatorState::addTo(Hash& hash) const {
  for (const PlaneField* field : {&amplitude, &rate}) {
    for (const double value : field->u) hash.add(value);
    for (const double value : field->v) hash.add(value);
  }
  hash.add(depth);
  hash.add(depth_rate);
}

Oscillator::Oscillator(const OscillatorSettings& settings, int size, double width)
    : settings_(settings),
      law_(lawOf(settings, width)),
      size_(size),
      fourier_(size),
      modal_(law_, size),
      verlet_(law_, size),
      force_(size) {
  reset();
}

void Oscillator::reset() {
  state_ = OscillatorState();
  state_.amplitude = state_.rate = motion_ = PlaneField(size_);
}

void Oscillator::restore(const OscillatorState& state) {
  for (const PlaneField* field : {&state.amplitude, &state.rate})
    if (field->size != size_ || field->u.size() != force_.area() ||
        field->v.size() != force_.area() || !(energyOf(*field) < MOST_MODE_ENERGY))
      throw InvalidInput("state: its motion is not finite, or of another size than " +
                         std::to_string(size_));
  if (!std::isfinite(state.depth) || !std::isfinite(state.depth_rate))
    throw InvalidInput("state: its motion in depth is not finite");
  state_ = state;
  show();
}

void Oscillator::show() {
  motion_ = state_.amplitude;
  if (settings_.integrator == LeafIntegrator::EXACT) fourier_.inverse(motion_);
}

void Oscillator::load(const PlaneField& wind) {
  for (std::size_t i = 0; i < force_.u.size(); ++i) {
    const double u = wind.u[i], v = wind.v[i];
    const double share = 1.0 / (1.0 + std::sqrt(u * u + v * v) / settings_.limit);
    force_.u[i] = u * share;
    force_.v[i] = v * share;
  }
}

void Oscillator::advance(double dt, const PlaneField& wind, double depth_wind) {
  if (!(dt > 0.0) || !std::isfinite(dt)) return;
  load(wind);
  const double rest = saturated(depth_wind, settings_.limit), offset = state_.depth - rest;
  const ModeStep step = modeStep(law_.damping * law_.omega, law_.omega * law_.omega, dt);
  state_.depth = rest + (step.keep * offset + step.from_rate * state_.depth_rate);
  state_.depth_rate = step.to_rate * offset + step.keep_rate * state_.depth_rate;
  if (settings_.integrator == LeafIntegrator::EXACT) {
    fourier_.forward(force_);
    modal_.step(dt, force_, state_.amplitude, state_.rate);
  } else {
    const double longest = MARGIN * verlet_.longestStep();
    const double count = std::min<double>(MOST_SUBSTEPS, std::ceil(dt / longest));
    const double part = std::min(dt / count, longest);
    if (count > 1.0) ++divided_;
    for (double i = 0.0; i < count; i += 1.0)
      verlet_.step(part, force_, state_.amplitude, state_.rate);
  }
  show();
}

}  // namespace vegetation_sim::canopy
