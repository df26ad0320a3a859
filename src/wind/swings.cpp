// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/swings.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/wind/breeze.h"
#include "vegetation_sim/wind/fade.h"
#include "vegetation_sim/wind/laws.h"

namespace vegetation_sim::wind {
namespace {

constexpr Nanoseconds LOOK = NANOSECONDS_PER_SECOND / 10;
// A rise by smootherStep in a time T is steepest with 15 / 8 T, as a swing of half its height at
// this frequency times 1 / T.
constexpr double RISE = 15.0 / (8.0 * PI);

template <std::size_t N>
std::pair<std::size_t, double> between(const std::array<double, N>& grid, double value) {
  std::size_t i = 0;
  while (i + 2 < N && grid[i + 1] <= value) ++i;
  return {i, saturate((value - grid[i]) / (grid[i + 1] - grid[i]))};
}

void addBreeze(const Primitive& p, double weight, std::uint64_t seed, Swings& out) {
  const double carrier = std::max(length(p.velocity), Breeze::LEAST_CARRIER);
  const Breeze breeze(p, seed);
  for (const Breeze::Wave& wave : breeze.waves()) {
    const double variance = 0.5 * dot(wave.at_epoch.amplitude, wave.at_epoch.amplitude);
    out.add(wave.frequency, 1.0 / carrier,
            weight * weight * SwingingWind::PEAK * SwingingWind::PEAK * variance);
  }
}

// How often what moves past comes and goes: a front by its steeper side, an eddy by how long its
// core takes.
double frequencyOf(const Primitive& p, const Field& alone, Nanoseconds stamp, const Term& now) {
  if (now.kind == Kind::DISK) return std::fabs(p.omega) / (2.0 * PI);
  if (now.kind == Kind::GUST) return RISE * p.front_speed / std::min(p.rise_length, p.decay_length);
  const Instant next = alone.at(stamp + LOOK);
  if (next.terms.empty()) return 0.0;
  const double speed = length(next.terms[0].centre - now.centre) / secondsBetween(0, LOOK);
  return speed / (4.0 * p.core_radius);
}

}  // namespace

void Swings::add(double frequency, double slowness, double square) {
  if (frequency < FREQUENCIES[0])
    square *= frequency * frequency / (FREQUENCIES[0] * FREQUENCIES[0]);
  const auto [f, across] = between(FREQUENCIES, frequency);
  const auto [s, along] = between(SLOWNESSES, slowness);
  power[s][f] += (1.0 - along) * (1.0 - across) * square;
  power[s][f + 1] += (1.0 - along) * across * square;
  power[s + 1][f] += along * (1.0 - across) * square;
  power[s + 1][f + 1] += along * across * square;
}

SwingingWind::SwingingWind(const Field& field, Nanoseconds stamp) {
  for (const Primitive& p : field.primitives()) {
    const double weight = fade(p, stamp);
    if (weight == 0.0) continue;
    if (static_cast<Kind>(p.kind) == Kind::BREEZE) {
      addBreeze(p, weight, field.seed(), breezes_);
      continue;
    }
    const Field alone({p}, field.seed());
    const Instant now = alone.at(stamp);
    if (now.terms.empty()) continue;
    const Term& term = now.terms[0];
    parts_.push_back(
        {term, frequencyOf(p, alone, stamp, term), term.kind == Kind::GUST ? 0.5 : 1.0});
  }
}

Swings SwingingWind::at(const Vec3& position, double reach) const {
  Swings out = breezes_;
  for (const Part& part : parts_) {
    const double speed = part.share * boundOf(part.term, position, reach);
    if (speed > 0.0) out.add(part.frequency, 0.0, speed * speed);
  }
  return out;
}

}  // namespace vegetation_sim::wind
