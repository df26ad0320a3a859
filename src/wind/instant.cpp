// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/instant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/math_batch.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/laws.h"

namespace vegetation_sim::wind {

Vec3 Instant::velocity(const Vec3& position) const {
  Vec3 sum = mean;
  constexpr std::size_t AT_ONCE = 32;
  std::array<double, AT_ONCE> turns;
  for (std::size_t first = 0; first < modes.size(); first += AT_ONCE) {
    const std::size_t count = std::min(AT_ONCE, modes.size() - first);
    for (std::size_t i = 0; i < count; ++i)
      turns[i] = dot(modes[first + i].wave, position) + modes[first + i].phase;
    batchCosTurns(turns.data(), count, turns.data());
    for (std::size_t i = 0; i < count; ++i) sum += modes[first + i].amplitude * turns[i];
  }
  for (const Term& term : terms) sum += velocityOf(term, position);
  return sum;
}

Instant Instant::relativeTo(const Vec3& origin) const {
  Instant moved = *this;
  for (Term& term : moved.terms) term.centre -= origin;
  for (Mode& mode : moved.modes) {
    const double turns = mode.phase + dot(mode.wave, origin);
    mode.phase = turns - std::floor(turns);
  }
  return moved;
}

namespace {

// Returns three standard deviations of the breezes [m/s].
double turbulence(const std::vector<Mode>& modes) {
  double variance = 0.0;
  for (const Mode& mode : modes) variance += 0.5 * dot(mode.amplitude, mode.amplitude);
  return 3.0 * std::sqrt(variance);
}

}  // namespace

double Instant::steadyBound() const {
  return length(mean) + turbulence(modes);
}

double Instant::speedBound(const Vec3& position, double reach, double steady) const {
  double bound = steady;
  for (const Term& term : terms) bound += boundOf(term, position, reach);
  return bound;
}

}  // namespace vegetation_sim::wind
