// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/fluid.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::canopy {
namespace {

constexpr double MOST_FLUID_ENERGY = 1e8;  // [m^2/s^2] limit against runaway, far above any wind

const FluidSettings& checked(const FluidSettings& settings) {
  Faults faults;
  check(settings, "fluid: ", faults);
  faults.throwIfAny();
  return settings;
}

}  // namespace

void describe(FieldVisitor& v, FluidSettings& s) {
  v.choice("scheme", s.scheme, {"reflection", "fast", "paper"});
  v.integer("cells", s.cells, "", {SMALLEST_FIELD, LARGEST_FIELD});
  v.number("viscosity", s.viscosity, "m^2/s", {0.0, 10.0});
  v.integer("sweeps", s.sweeps, "", {1, 1000});
}

void check(FluidSettings settings, const std::string& context, Faults& faults) {
  FieldChecker checker(context, faults);
  describe(checker, settings);
  checker.number("width", settings.width, "m", {0.02, 10000.0});
  if (settings.cells >= SMALLEST_FIELD && settings.cells <= LARGEST_FIELD &&
      !isFieldSize(settings.cells))
    faults.add(context + "cells = " + std::to_string(settings.cells) +
               " is no power of two; allowed are 16, 32, 64, 128 and 256");
}

void FluidState::addTo(Hash& hash) const {
  for (const double value : flow.u) hash.add(value);
  for (const double value : flow.v) hash.add(value);
  for (const double value : turbulence) hash.add(value);
  hash.add(steps);
}

Fluid::Fluid(const FluidSettings& settings, const SourceSettings& sources, std::uint64_t seed)
    : settings_(checked(settings)),
      sources_(sources, settings.cells, seed),
      projection_(settings.cells),
      paper_(settings.cells, settings.sweeps, false),
      half_(settings.cells),
      reflected_(settings.cells) {
  reset();
}

void Fluid::reset() {
  state_ = FluidState();
  state_.flow = PlaneField(settings_.cells);
}

void Fluid::restore(const FluidState& state) {
  if (state.flow.size != settings_.cells || state.flow.u.size() != half_.area() ||
      state.flow.v.size() != half_.area())
    throw InvalidInput("state: " + std::to_string(state.flow.size) + " cells, allowed are " +
                       std::to_string(settings_.cells));
  double sum = energyOf(state.flow);
  for (const double value : state.turbulence) sum += value * value;
  if (!(sum < MOST_FLUID_ENERGY)) throw InvalidInput("state: its flow is not finite or too large");
  state_ = state;
}

void Fluid::advance(double from, double dt, const PlaneAir* air) {
  if (!(dt > 0.0) || !std::isfinite(dt) || !std::isfinite(from)) return;
  const double longest = LONGEST_SUBSTEP * MOST_SUBSTEPS;
  if (dt > longest) {
    figures_.skipped += dt - longest;
    from += dt - longest;
    dt = longest;
  }
  const double count = std::ceil(dt / LONGEST_SUBSTEP);
  for (double i = 0.0; i < count; i += 1.0)
    substep({from + dt * (i / count), dt / count, state_.steps}, air);
}

void Fluid::substep(const Interval& interval, const PlaneAir* air) {
  last_good_ = state_.flow;
  const Turbulence turbulence = state_.turbulence;
  sources_.carryOn(interval, state_.turbulence);
  const double before = energyOf(state_.flow);
  given_ = 0.0;
  const double cells = interval.length * settings_.cells / settings_.width;
  const double decay = settings_.viscosity * interval.length / (settings_.width * settings_.width);
  switch (settings_.scheme) {
    case Scheme::REFLECTION:
      reflect(interval, air, cells, decay);
      break;
    case Scheme::FAST:
      blow(interval, air, state_.flow);
      advect(state_.flow, state_.flow, cells, Lookup::BILINEAR, half_);
      std::swap(state_.flow, half_);
      projection_.project(state_.flow, decay);
      break;
    case Scheme::PAPER:
      blow(interval, air, state_.flow);
      paper_.step(state_.flow, decay, cells);
  }
  limitEnergy(before + given_);
  ++state_.steps;
  if (energyOf(state_.flow) < MOST_FLUID_ENERGY) return;
  state_.flow = last_good_;
  state_.turbulence = turbulence;
  ++figures_.resets;
}

// Zehnder, Narain and Thomaszewski, "An advection-reflection solver for detail-preserving fluid
// simulation", ACM TOG 37(4), 2018: what the projection removes at half time is reflected, so that
// the second half of the step gives it back. Sources act on both sides of the reflection, so that
// pressure spreads their push over the plane while they act.
void Fluid::reflect(const Interval& interval, const PlaneAir* air, double cells, double decay) {
  const double half = 0.5 * interval.length;
  advect(state_.flow, state_.flow, 0.5 * cells, Lookup::CUBIC, reflected_);
  blow({interval.from, half, interval.number}, air, reflected_);
  half_ = reflected_;
  projection_.project(half_, 0.0);
  for (std::size_t i = 0; i < half_.u.size(); ++i) {
    reflected_.u[i] = 2.0 * half_.u[i] - reflected_.u[i];
    reflected_.v[i] = 2.0 * half_.v[i] - reflected_.v[i];
  }
  blow({interval.from + half, half, interval.number}, air, reflected_);
  advect(reflected_, half_, 0.5 * cells, Lookup::CUBIC, state_.flow);
  projection_.project(state_.flow, decay);
}

void Fluid::blow(const Interval& interval, const PlaneAir* air, PlaneField& flow) {
  const double before = energyOf(flow);
  sources_.apply(interval, air, state_.turbulence, flow);
  given_ += energyOf(flow) - before;
}

// Only sources add energy, but the cubic interpolation may overshoot slightly.
void Fluid::limitEnergy(double most) {
  const double now = energyOf(state_.flow);
  if (!(now > most)) return;
  const double scale = std::sqrt(std::max(0.0, most) / now);
  for (double& value : state_.flow.u) value *= scale;
  for (double& value : state_.flow.v) value *= scale;
}

}  // namespace vegetation_sim::canopy
