// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/gauss_markov.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/breeze.h"
#include "wind/wind_axes.h"

namespace vegetation_sim::wind {
namespace {

constexpr std::int64_t CELL = std::int64_t{1} << GaussMarkovProcess::HALVINGS;  // [samples]

// The value in the middle of two others, given both: share * (sum of both) + spread * normal.
struct Bridge {
  double share, spread;
};

// Returns the bridges of the intervals CELL, CELL / 2, ..., 2.
std::array<Bridge, GaussMarkovProcess::HALVINGS> bridges() {
  std::array<Bridge, GaussMarkovProcess::HALVINGS> out{};
  double half = 0.5 * CELL / GaussMarkovProcess::PER_SCALE;  // [scales]
  for (Bridge& bridge : out) {
    const double kept = exponential(-half), square = kept * kept;
    bridge = {kept / (1.0 + square), std::sqrt((1.0 - square) / (1.0 + square))};
    half *= 0.5;
  }
  return out;
}

// Returns the inverse of the rms of the spline, in the mean of all times, over that of the samples:
// the products of B-spline weights are in the mean 2416, 1191, 120 and 1 over 5040 at the distances
// 0 to 3.
double splineScale() {
  const double a = exponential(-1.0 / GaussMarkovProcess::PER_SCALE);
  return std::sqrt(5040.0 / (2416.0 + 2.0 * a * (1191.0 + a * (120.0 + a))));
}

}  // namespace

// Uses the method of Box and Muller.
double GaussMarkovProcess::normal(std::uint64_t cell, std::uint64_t node) const {
  const std::uint64_t index = 2 * (cell * 2 * CELL + node);
  const double radius = std::sqrt(-2.0 * logarithm(1.0 - random_.uniform(index)));
  return radius * sinCosTurns(random_.uniform(index + 1)).cos;
}

// Both ends of a cell are independent: they are 32 scales apart, where the correlation is 1e-14.
// In between, intervals are halved by the exact conditional distribution. Nodes of a cell have the
// indices of a binary heap; 0 is its left end.
double GaussMarkovProcess::sample(std::int64_t index) const {
  static const auto BRIDGES = bridges();
  std::int64_t cell = index / CELL, rest = index % CELL;
  if (rest < 0) --cell, rest += CELL;
  const auto key = static_cast<std::uint64_t>(cell);
  double low = normal(key, 0);
  if (rest == 0) return low;
  double high = normal(key + 1, 0);
  std::uint64_t node = 1;
  std::int64_t half = CELL / 2;
  for (const Bridge& bridge : BRIDGES) {
    const double middle = bridge.share * (low + high) + bridge.spread * normal(key, node);
    if (rest == half) return middle;
    const bool right = rest > half;
    (right ? low : high) = middle;
    if (right) rest -= half;
    node = 2 * node + (right ? 1 : 0);
    half /= 2;
  }
  return low;
}

double GaussMarkovProcess::at(double time) const {
  static const double SCALE = splineScale();
  const double place = std::clamp(time, -MOST, MOST) * PER_SCALE, whole = std::floor(place);
  const double u = place - whole, v = 1.0 - u;
  const auto first = static_cast<std::int64_t>(whole) - 1;
  const std::array<double, 4> weights{v * v * v, 4.0 - 6.0 * u * u + 3.0 * u * u * u,
                                      4.0 - 6.0 * v * v + 3.0 * v * v * v, u * u * u};
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum += weights[i] * sample(first + static_cast<std::int64_t>(i));
  return SCALE / 6.0 * sum;
}

GaussMarkov::GaussMarkov(const Primitive& p, std::uint64_t seed) : time_scale_(p.time_scale) {
  const double speed = length(p.velocity), sigma = p.turbulence * speed;
  if (!(sigma > 0.0)) return;
  const WindAxes axes = axesOf(p.velocity, speed);
  axes_ = {sigma * axes.along, sigma * Breeze::LATERAL * axes.across,
           sigma * Breeze::VERTICAL * axes.up};
  double square = 0.0;
  for (const Vec3& axis : axes_) square += dot(axis, axis);
  rms_ = std::sqrt(square);
  Hash name;
  name.add(p.name);
  random_ = Random(seed).child(name.value());
}

Vec3 GaussMarkov::at(double elapsed) const {
  Vec3 out = Vec3::Zero();
  if (!(rms_ > 0.0)) return out;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    out += axes_[i] * GaussMarkovProcess(random_.child(i)).at(elapsed / time_scale_);
  return out;
}

double lorentzianDensity(double f, double sigma, double time_scale) {
  const double x = 2.0 * PI * f * time_scale;
  return 4.0 * sigma * sigma * time_scale / (1.0 + x * x);
}

}  // namespace vegetation_sim::wind
