// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/breeze.h"

#include <array>
#include <cmath>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "wind/wind_axes.h"

namespace vegetation_sim::wind {
namespace {

enum Draw : std::uint64_t { JITTER, PHASE, SIGN_LATERAL, SIGN_VERTICAL, ACROSS, UP, DRAWS };

constexpr double WIDEST_DRAW = 10.0;  // [scales] 94 % of Cauchy's distribution lie within

/// Maps a uniform u in [0, 1) to Cauchy's distribution of unit scale, whose characteristic function
/// is the exponential that Davenport's coherence needs. The tails beyond WIDEST_DRAW are left out.
double cauchy(double u) {
  static const double KEPT = 2.0 * arcTangent(WIDEST_DRAW, 1.0) / PI;
  const SinCos angle = sinCosTurns(0.5 * KEPT * (u - 0.5));
  return angle.sin / angle.cos;
}

using Edges = std::array<double, Breeze::MODES + 1>;

/// Returns the edges of the frequency bins [Hz], geometrically spaced.
Edges binEdges() {
  static_assert(Breeze::MODES == 24, "the ratio below is the 24th root");
  const double range = Breeze::HIGHEST_HZ / Breeze::LOWEST_HZ;
  const double ratio = cubeRoot(std::sqrt(std::sqrt(std::sqrt(range))));
  Edges edges{};
  edges[0] = Breeze::LOWEST_HZ;
  for (std::size_t i = 1; i < edges.size(); ++i) edges[i] = edges[i - 1] * ratio;
  return edges;
}

/// Returns each bin's share of the variance of the whole band; the sum is 1.
std::array<double, Breeze::MODES> sharesOfVariance(const Edges& edges, double length_scale,
                                                   double speed) {
  std::array<double, Breeze::MODES> shares{};
  double total = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double centre = std::sqrt(edges[i] * edges[i + 1]);
    shares[i] = vonKarmanDensity(centre, 1.0, length_scale, speed) * (edges[i + 1] - edges[i]);
    total += shares[i];
  }
  for (double& share : shares) share /= total;
  return shares;
}

}  // namespace

double vonKarmanDensity(double f, double sigma, double length_scale, double speed) {
  const double n = f * length_scale / speed;
  const double sixth = std::sqrt(cubeRoot(1.0 + 70.8 * n * n));
  const double power = sixth * sixth * sixth * sixth * sixth;  // ^(5/6)
  return sigma * sigma * 4.0 * (length_scale / speed) / power;
}

Breeze::Breeze(const Primitive& p, std::uint64_t seed) {
  const double speed = length(p.velocity), sigma = p.turbulence * speed;
  if (!(sigma > 0.0)) return;
  const double carrier = std::max(speed, LEAST_CARRIER);
  const WindAxes axes = axesOf(p.velocity, speed);
  Hash name;
  name.add(p.name);
  const Random random = Random(seed).child(name.value());
  const auto edges = binEdges();
  const auto shares = sharesOfVariance(edges, p.length_scale, carrier);
  for (std::size_t i = 0; i < MODES; ++i) {
    const auto draw = [&](Draw which) { return random.uniform(i * DRAWS + which); };
    const double f = edges[i] + draw(JITTER) * (edges[i + 1] - edges[i]);
    const double size = sigma * std::sqrt(2.0 * shares[i]);
    const double spread = DECAY * f / (2.0 * PI * carrier);  // of the wave vector [turns/m]
    Wave wave;
    wave.frequency = f;
    wave.at_epoch.phase = draw(PHASE);
    wave.at_epoch.wave = axes.along * (f / carrier) +
                         axes.across * (spread * cauchy(draw(ACROSS))) +
                         axes.up * (spread * cauchy(draw(UP)));
    wave.at_epoch.amplitude =
        size * (axes.along + axes.across * (draw(SIGN_LATERAL) < 0.5 ? -LATERAL : LATERAL) +
                axes.up * (draw(SIGN_VERTICAL) < 0.5 ? -VERTICAL : VERTICAL));
    waves_.push_back(wave);
  }
}

void Breeze::addModes(double elapsed, double weight, std::vector<Mode>& modes) const {
  for (const Wave& wave : waves_) {
    Mode mode = wave.at_epoch;
    const double turns = mode.phase - wave.frequency * elapsed;
    mode.phase = turns - std::floor(turns);
    mode.amplitude *= weight;
    modes.push_back(mode);
  }
}

}  // namespace vegetation_sim::wind
