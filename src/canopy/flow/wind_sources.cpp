// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/wind_sources.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr std::array<const char*, SIDES> NAMES{"rightward", "leftward", "upward", "downward"};
constexpr std::array<const char*, SIDES> FREQUENCIES{"rightward_frequency", "leftward_frequency",
                                                     "upward_frequency", "downward_frequency"};
constexpr int LEAST_BAND = 2;  // [cells]

// Returns a bounded random number with mean 0 and variance 1: the sum of four parts of a random
// word (Irwin and Hall).
double normal(const Random& random, std::uint64_t index) {
  double sum = 0.0;
  for (std::uint64_t half = 0; half < 2; ++half) {
    const std::uint64_t bits = random.bits(2 * index + half);
    for (int piece = 0; piece < 4; ++piece)
      sum += (static_cast<double>((bits >> (16 * piece)) & 0xffffU) + 0.5) / 65536.0 - 0.5;
  }
  return sum * std::sqrt(12.0 / 8.0);
}

// Returns the share of the difference that relaxation at `rate` removes in `length`.
double share(double rate, double length) {
  return 1.0 - exponential(-rate * length);
}

}  // namespace

void describe(FieldVisitor& v, SourceSettings& s) {
  for (std::size_t side = 0; side < SIDES; ++side) {
    v.number(NAMES[side], s.sides[side].strength, "m/s", {0.0, 50.0});
    v.number(FREQUENCIES[side], s.sides[side].frequency, "Hz", {0.0, 100.0});
  }
  v.number("steadiness", s.steadiness, "", {0.0, 1.0});
  v.number("turbulence", s.turbulence, "", {0.0, 1.0});
  v.number("turbulence_time", s.turbulence_time, "s", {0.01, 60.0});
  v.number("fringe", s.fringe, "", {0.01, 0.4});
  v.number("fringe_rate", s.fringe_rate, "1/s", {0.01, 1000.0});
  v.number("law_gain", s.law_gain, "", {0.0, 10.0});
  v.number("follow_rate", s.follow_rate, "1/s", {0.0, 1000.0});
}

Sources::Sources(const SourceSettings& settings, int size, std::uint64_t seed)
    : settings_(settings), random_(seed) {
  const double width = std::max<double>(LEAST_BAND, settings.fringe * size);
  for (int i = 0; i < size; ++i) band_.push_back(1.0 - smoothStep((i - 0.5 * width) / width));
}

void Sources::apply(const Interval& interval, const PlaneAir* air, const Turbulence& turbulence,
                    PlaneField& flow) const {
  if (air && settings_.law_gain > 0.0) applyAir(interval.length, *air, flow);
  for (int side = 0; side < SIDES; ++side)
    if (settings_.sides[static_cast<std::size_t>(side)].strength > 0.0)
      applySide(side, interval, turbulence, flow);
}

// Makes the exact step of an Ornstein-Uhlenbeck process, whose distribution does not depend on the
// length.
void Sources::carryOn(const Interval& interval, Turbulence& turbulence) const {
  const double keep = exponential(-interval.length / settings_.turbulence_time);
  const double kick = std::sqrt(1.0 - keep * keep) / std::sqrt(1.0 * TURBULENCE_MODES);
  for (std::size_t i = 0; i < turbulence.size(); ++i)
    turbulence[i] =
        keep * turbulence[i] + kick * normal(random_, interval.number * turbulence.size() + i);
}

// Returns the mean over the step, so that a swell faster than the steps is not aliased.
double Sources::swell(int side, const Interval& interval) const {
  const SideWind& wind = settings_.sides[static_cast<std::size_t>(side)];
  const double b = settings_.steadiness, turns = wind.frequency * interval.length;
  if (!(turns > 1e-9))
    return wind.strength *
           (b + 0.5 * (1.0 - b) * (1.0 + sinCosTurns(wind.frequency * interval.from).sin));
  const double start = sinCosTurns(wind.frequency * interval.from).cos;
  const double end = sinCosTurns(wind.frequency * (interval.from + interval.length)).cos;
  const double mean_sine = (start - end) / (2.0 * PI * turns);
  return wind.strength * (b + 0.5 * (1.0 - b) * (1.0 + mean_sine));
}

void Sources::applySide(int side, const Interval& interval, const Turbulence& turbulence,
                        PlaneField& flow) const {
  const int size = flow.size;
  const bool across = side < 2, backward = side % 2 == 1;
  const double mean = swell(side, interval);
  const double rms =
      settings_.turbulence * settings_.sides[static_cast<std::size_t>(side)].strength;
  const std::size_t first = static_cast<std::size_t>(side) * 2 * TURBULENCE_MODES;
  std::vector<double>& along = across ? flow.u : flow.v;
  std::vector<double>& beside = across ? flow.v : flow.u;
  for (int place = 0; place < size; ++place) {
    double gust = 0.0;
    for (std::size_t m = 0; m < TURBULENCE_MODES; ++m) {
      const SinCos wave = sinCosTurns(static_cast<double>(m + 1) * place / size);
      gust += turbulence[first + 2 * m] * wave.cos + turbulence[first + 2 * m + 1] * wave.sin;
    }
    const double wind = (backward ? -1.0 : 1.0) * (mean + rms * gust);
    for (int depth = 0; depth < size && band_[static_cast<std::size_t>(depth)] > 0.0; ++depth) {
      const int cell = backward ? size - 1 - depth : depth;
      const auto i = static_cast<std::size_t>(across ? place * size + cell : cell * size + place);
      const double part =
          share(settings_.fringe_rate * band_[static_cast<std::size_t>(depth)], interval.length);
      along[i] += part * (wind - along[i]);
      beside[i] -= part * beside[i];
    }
  }
}

void Sources::applyAir(double length, const PlaneAir& air, PlaneField& flow) const {
  const int size = flow.size;
  std::vector<double> part;  // by distance from the nearest edge
  for (const double band : band_)
    part.push_back(share(settings_.fringe_rate * band + settings_.follow_rate, length));
  const double step = (AIR_NODES - 1.0) / (size - 1.0);
  for (int row = 0; row < size; ++row) {
    const int j = std::min(AIR_NODES - 2, static_cast<int>(row * step));
    const double q = row * step - j;
    for (int column = 0; column < size; ++column) {
      const int i = std::min(AIR_NODES - 2, static_cast<int>(column * step));
      const double p = column * step - i;
      const PlaneVector* low = air.nodes.data() + j * AIR_NODES + i;
      const PlaneVector* high = low + AIR_NODES;
      const auto mix = [&](double a, double b, double c, double d) {
        return settings_.law_gain *
               ((1.0 - q) * ((1.0 - p) * a + p * b) + q * ((1.0 - p) * c + p * d));
      };
      const int edge = std::min({row, column, size - 1 - row, size - 1 - column});
      const double w = part[static_cast<std::size_t>(edge)];
      const auto cell = static_cast<std::size_t>(row * size + column);
      flow.u[cell] += w * (mix(low[0].u, low[1].u, high[0].u, high[1].u) - flow.u[cell]);
      flow.v[cell] += w * (mix(low[0].v, low[1].v, high[0].v, high[1].v) - flow.v[cell]);
    }
  }
}

}  // namespace vegetation_sim::canopy
