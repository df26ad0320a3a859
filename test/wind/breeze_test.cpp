// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/breeze.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::wind {
namespace {

constexpr double RATE = 8.0, DURATION = 600.0;  // [Hz], [s]

Primitive breeze() {
  Primitive p = example(Kind::BREEZE, "sea_breeze");
  p.velocity = Vec3(3.0, 4.0, 0.0);  // 5 m/s along (0.6, 0.8)
  p.turbulence = 0.3;
  return p;
}

/// Returns ten minutes at one point: along, across and up [m/s].
std::array<std::vector<double>, 3> record(const Primitive& p, std::uint64_t seed) {
  const Field field({p}, seed);
  std::array<std::vector<double>, 3> out;
  for (int i = 0; i < static_cast<int>(DURATION * RATE); ++i) {
    const Vec3 air = field.velocity(Vec3(7.0, -2.0, 3.0), at(100.0 + i / RATE));
    out[0].push_back(0.6 * air.x() + 0.8 * air.y());
    out[1].push_back(-0.8 * air.x() + 0.6 * air.y());
    out[2].push_back(air.z());
  }
  return out;
}

double meanOf(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double rmsOf(const std::vector<double>& x) {
  const double mean = meanOf(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

TEST(Breeze, HasTheStatedMeanAndVarianceOverTenMinutes) {  // S2-20, S1-W1
  // The slowest mode has a period of 100 s; an incomplete one shifts the mean of 600 s by up to its
  // amplitude / (6 pi), and beating neighbours change the rms by a few per cent.
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const auto air = record(breeze(), seed);
    EXPECT_NEAR(meanOf(air[0]), 5.0, 0.05) << seed;
    EXPECT_NEAR(rmsOf(air[0]), 1.5, 0.15) << seed;
    EXPECT_NEAR(rmsOf(air[1]), 1.5 * Breeze::LATERAL, 0.12) << seed;
    EXPECT_NEAR(rmsOf(air[2]), 1.5 * Breeze::VERTICAL, 0.075) << seed;
  }
}

TEST(Breeze, HasExactlyTheStatedVarianceInItsModes) {  // S2-20
  double along = 0.0;
  for (const Mode& mode : Field({breeze()}, 3).at(0).modes) {
    const double part = 0.6 * mode.amplitude.x() + 0.8 * mode.amplitude.y();
    along += 0.5 * part * part;
  }
  EXPECT_NEAR(along, 1.5 * 1.5, 1e-12);
}

/// Variance of a record in [low, high) Hz, by a Fourier sum with a Hann window.
double bandVariance(std::vector<double> x, double low, double high) {
  const double mean = meanOf(x), n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = (x[i] - mean) * (1.0 - sinCosTurns(static_cast<double>(i) / n).cos);
  double variance = 0.0;
  for (int k = static_cast<int>(std::ceil(low * DURATION)); k < high * DURATION; ++k) {
    double re = 0.0, im = 0.0;
    const SinCos step = sinCosTurns(k / n);
    double c = 1.0, s = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      re += x[i] * c;
      im += x[i] * s;
      const double next = c * step.cos - s * step.sin;
      s = s * step.cos + c * step.sin;
      c = next;
    }
    variance += 2.0 * (re * re + im * im) / (n * n) / 1.5;  // 1.5: mean square of the window
  }
  return variance;
}

/// Returns the share of the stated spectrum in [low, high) Hz, of its integral over the whole band.
double statedShare(const Primitive& p, double low, double high) {
  const auto integral = [&](double from, double to) {
    double sum = 0.0;
    const double ratio = 1.001;
    for (double f = from; f < to; f *= ratio)
      sum += vonKarmanDensity(f, 1.0, p.length_scale, length(p.velocity)) * f * (ratio - 1.0);
    return sum;
  };
  return integral(low, high) / integral(Breeze::LOWEST_HZ, Breeze::HIGHEST_HZ);
}

TEST(Breeze, HasTheStatedSpectrumInOctaves) {  // S2-20
  constexpr int SEEDS = 40;
  std::array<double, 6> measured{};
  for (std::uint64_t seed = 0; seed < SEEDS; ++seed) {
    const auto air = record(breeze(), seed)[0];
    double low = 0.02;
    for (double& variance : measured) {
      variance += bandVariance(air, low, 2.0 * low) / (2.25 * SEEDS);
      low *= 2.0;
    }
  }
  double low = 0.02;
  for (const double share : measured) {
    // Three modes an octave, each anywhere in its bin: those of the bins at both edges are in or
    // out at random, which leaves sqrt(40 * 2 / 4) of 40 * 3 modes, 4 %, as standard deviation.
    EXPECT_NEAR(share / statedShare(breeze(), low, 2.0 * low), 1.0, 0.12) << low << " Hz";
    low *= 2.0;
  }
}

TEST(Breeze, IsNoWhiteNoise) {  // S1-W1
  const auto air = record(breeze(), 4)[0];
  EXPECT_LT(bandVariance(air, 2.05, 4.0), 1e-6);
  double change = 0.0;
  for (std::size_t i = 1; i < air.size(); ++i)
    change += (air[i] - air[i - 1]) * (air[i] - air[i - 1]);
  EXPECT_LT(std::sqrt(change / static_cast<double>(air.size())), 0.25 * rmsOf(air));
}

TEST(Breeze, HasComponentsThatAreUncorrelatedOnAverage) {  // S2-20
  Vec3 products = Vec3::Zero();  // along across, along up, across up; over rms
  constexpr int SEEDS = 400;
  for (std::uint64_t seed = 0; seed < SEEDS; ++seed) {
    for (const Mode& mode : Field({breeze()}, seed).at(0).modes) {
      const double along = 0.6 * mode.amplitude.x() + 0.8 * mode.amplitude.y();
      const double across = -0.8 * mode.amplitude.x() + 0.6 * mode.amplitude.y();
      const double up = mode.amplitude.z();
      products += Vec3(along * across / Breeze::LATERAL, along * up / Breeze::VERTICAL,
                       across * up / (Breeze::LATERAL * Breeze::VERTICAL)) /
                  (2.0 * 2.25 * SEEDS);
    }
  }
  // Random signs of modes that hold up to a fifth of the variance each: 0.4 / sqrt(400).
  EXPECT_LT(products.cwiseAbs().maxCoeff(), 0.07) << products.transpose();
}

TEST(Breeze, CarriesItsGustsAlongWithTheMeanWind) {  // S2-20: frozen turbulence
  Primitive p = breeze();
  const Field field({p}, 9);
  Instant now = field.at(at(50.0)), later = field.at(at(52.0));
  // A point that moves along the wind at 5 m/s has the same velocity at all times: only across the
  // wind do points differ.
  for (const double x : {0.0, 3.0, 20.0}) {
    const Vec3 position(x, -x, 1.0), carried = position + p.velocity * 2.0;
    EXPECT_LT(length(later.velocity(carried) - now.velocity(position)), 1e-9);
  }
}

TEST(Breeze, LosesCoherenceAcrossTheWindAsStated) {  // S2-20
  const double speed = 5.0;
  constexpr int SEEDS = 3000;
  for (const std::size_t bin : {3u, 10u, 17u}) {
    for (const double share : {0.5, 1.0, 2.0}) {  // of the decay exponent C f r / U
      double coherence = 0.0;
      for (std::uint64_t seed = 0; seed < SEEDS; ++seed) {
        const Mode mode = Field({breeze()}, seed).at(0).modes.at(bin);
        const double f = speed * (0.6 * mode.wave.x() + 0.8 * mode.wave.y());
        const double r = share * speed / (Breeze::DECAY * f);
        coherence += sinCosTurns(dot(mode.wave, Vec3(-0.8, 0.6, 0.0) * r)).cos / SEEDS;
      }
      // Spread of a mean of cosines: 0.7 / sqrt(3000) = 0.013; the omitted tails add 0.03.
      EXPECT_NEAR(coherence, std::exp(-share), 0.06) << "bin " << bin;
    }
  }
}

TEST(Breeze, IsMoreAlikeAtNearPointsThanAtFarOnes) {  // S2-20
  const auto likeness = [](double distance) {
    double product = 0.0, square = 0.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Field field({breeze()}, seed);
      for (double t = 0.0; t < 300.0; t += 0.5) {
        const Instant air = field.at(at(t));
        const double here = air.velocity(Vec3::Zero()).x() - 3.0;
        product += here * (air.velocity(Vec3(-0.8, 0.6, 0.0) * distance).x() - 3.0);
        square += here * here;
      }
    }
    return product / square;
  };
  const double near = likeness(1.0), middle = likeness(8.0), far = likeness(60.0);
  EXPECT_GT(near, 0.7);
  EXPECT_GT(near, middle + 0.1);
  EXPECT_GT(middle, far + 0.1);
}

TEST(Breeze, IsSteadyWithoutTurbulenceAndNothingInACalm) {
  Primitive p = breeze();
  p.turbulence = 0.0;
  EXPECT_EQ(Field({p}).velocity(Vec3(1.0, 2.0, 3.0), at(17.0)), p.velocity);
  p.turbulence = 0.5;
  p.velocity = Vec3::Zero();
  EXPECT_EQ(Field({p}).velocity(Vec3(1.0, 2.0, 3.0), at(17.0)), p.velocity);
}

TEST(Breeze, DependsOnSeedAndNameOnly) {  // N2
  const auto air = [](const Primitive& p, std::uint64_t seed) {
    return Field({p}, seed).velocity(Vec3(1.0, 2.0, 3.0), at(17.0));
  };
  Primitive renamed = breeze(), renumbered = breeze();
  renamed.name = "land_breeze";
  renumbered.id = 77;
  EXPECT_NE(air(breeze(), 1), air(breeze(), 2));
  EXPECT_NE(air(breeze(), 1), air(renamed, 1));
  EXPECT_EQ(air(breeze(), 1), air(renumbered, 1));
}

}  // namespace
}  // namespace vegetation_sim::wind
