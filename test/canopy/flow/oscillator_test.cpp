// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/oscillator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <limits>

#include "scenes/canopy/plane_scene.h"

namespace vegetation_sim::canopy {
namespace {

using Long = long double;
using LongComplex = std::complex<long double>;

/// Displacement of a'' + 2 alpha a' + stiffness a = 0 from (1, 0) and (0, 1) by its two roots, in
/// extended precision.
std::pair<double, double> analytic(Long alpha, Long stiffness, Long t) {
  const LongComplex root = std::sqrt(LongComplex(alpha * alpha - stiffness));
  const LongComplex p = -alpha + root, q = -alpha - root;
  const LongComplex ep = std::exp(p * t), eq = std::exp(q * t);
  return {static_cast<double>(((p * eq - q * ep) / (p - q)).real()),
          static_cast<double>(((ep - eq) / (p - q)).real())};
}

// S3-12: all regimes, to 100 s.
TEST(ModeStep, IsTheAnalyticSolutionForAnyStep) {
  const double omega = 2.0 * PI;
  for (const double damping : {0.0, 0.15, 0.5, 0.999, 1.001, 2.0, 50.0})
    for (const double dt : {1e-9, 1e-3, 1.0 / 30.0, 0.5, 10.0, 100.0}) {
      const double alpha = damping * omega, stiffness = omega * omega;
      const auto [from_offset, from_rate] = analytic(alpha, stiffness, dt);
      const ModeStep step = modeStep(alpha, stiffness, dt);
      EXPECT_NEAR(step.keep, from_offset, 1e-12) << damping << ", " << dt;
      EXPECT_NEAR(step.from_rate, from_rate, 1e-12) << damping << ", " << dt;
    }
}

TEST(ModeStep, IsFiniteAndDecaysInEveryRegime) {
  for (const double damping : {0.0, 1.0, 1.0 + 1e-7, 50.0})
    for (const double dt : {0.0, 1e-9, 0.01, 100.0, 1e4}) {
      const double alpha = 6.0 * damping;
      const ModeStep step = modeStep(alpha, 36.0, dt);
      const double determinant = step.keep * step.keep_rate - step.from_rate * step.to_rate;
      ASSERT_TRUE(std::isfinite(determinant)) << damping << ", " << dt;
      EXPECT_NEAR(determinant, std::exp(-2.0 * alpha * dt), 1e-12) << damping << ", " << dt;
      EXPECT_LE(std::fabs(step.keep), 1.0 + 1e-12);
    }
  EXPECT_EQ(modeStep(1.0, 36.0, 0.0).keep, 1.0);
}

PlaneField evenWind(int size, double u, double v) {
  PlaneField out(size);
  std::fill(out.u.begin(), out.u.end(), u);
  std::fill(out.v.begin(), out.v.end(), v);
  return out;
}

OscillatorSettings with(const char* integrator) {
  OscillatorSettings out;
  out.integrator =
      std::string(integrator) == "verlet" ? LeafIntegrator::VERLET : LeafIntegrator::EXACT;
  out.limit = 200.0;
  return out;
}

double rootMeanSquare(const PlaneField& field) {
  return std::sqrt(2.0 * energyOf(field));
}

// S3-12: whatever the step, the same motion.
TEST(Oscillator, OneStepIsSixteenOfASixteenth) {
  const PlaneField wind = smoothFlow(32, 1);
  Oscillator one(with("exact"), 32, 4.0), many(with("exact"), 32, 4.0);
  for (const double dt : {1.0 / 30.0, 1.0, 10.0}) {
    one.advance(dt, wind, 0.3);
    for (int i = 0; i < 16; ++i) many.advance(dt / 16.0, wind, 0.3);
    EXPECT_LT(relativeError(one.motion(), many.motion()), 1e-12) << dt;
    EXPECT_NEAR(one.depth(), many.depth(), 1e-12) << dt;
  }
}

// S3-12
TEST(Oscillator, OscillatesAndComesToRestWhereTheWindHoldsIt) {
  for (const char* integrator : {"exact", "verlet"}) {
    Oscillator leaves(with(integrator), 32, 4.0);
    const PlaneField wind = evenWind(32, 2.0, -1.0);
    double largest = 0.0;
    for (int i = 0; i < 600; ++i) {
      leaves.advance(1.0 / 60.0, wind, 0.5);
      largest = std::max(largest, leaves.motion().u[17]);
    }
    const double share = 1.0 / (1.0 + std::sqrt(5.0) / 200.0);
    EXPECT_GT(largest, 1.4 * 2.0 * share) << integrator;  // 15 % damping: overshoots by 62 %
    // 10 s are 12 periods: exp(-2 pi 0.15 12) is 1e-5.
    EXPECT_NEAR(leaves.motion().u[17], 2.0 * share, 1e-4) << integrator;
    EXPECT_NEAR(leaves.motion().v[300], -share, 1e-4) << integrator;
    EXPECT_NEAR(leaves.depth(), 0.5 / (1.0 + 0.5 / 200.0), 1e-4) << integrator;
  }
}

TEST(Oscillator, SaturatesInAStorm) {
  OscillatorSettings settings;
  settings.limit = 5.0;
  settings.damping = 1.0;
  Oscillator leaves(settings, 16, 4.0);
  for (int i = 0; i < 100; ++i) leaves.advance(0.1, evenWind(16, 1000.0, 0.0), 1000.0);
  EXPECT_NEAR(leaves.motion().u[3], 5.0, 0.03);
  EXPECT_LT(leaves.depth(), 5.0);
}

// S3-12: a push in one place spreads as a wave.
TEST(Oscillator, CarriesAPushToItsNeighbours) {
  OscillatorSettings settings = with("exact");
  settings.speed = 2.0;
  Oscillator leaves(settings, 64, 4.0);
  PlaneField wind(64);
  wind.u[32 * 64 + 32] = 100.0;
  leaves.advance(0.02, wind, 0.0);
  const double near_then = std::fabs(leaves.motion().u[32 * 64 + 32]);
  const double far_then = std::fabs(leaves.motion().u[32 * 64 + 48]);
  EXPECT_LT(far_then, 1e-3 * near_then);
  double far = 0.0;
  for (int i = 0; i < 40; ++i) {  // one metre takes half a second
    leaves.advance(0.02, PlaneField(64), 0.0);
    far = std::max(far, std::fabs(leaves.motion().u[32 * 64 + 48]));
  }
  EXPECT_GT(far, 0.01 * near_then);
}

// S3-12: the energy of free waves falls with each step.
TEST(Oscillator, LosesEnergyWhenTheWindStops) {
  Oscillator leaves(with("exact"), 32, 4.0);
  leaves.advance(0.3, smoothFlow(32, 2), 0.0);
  const double omega = 2.0 * PI * 1.2;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    leaves.advance(1.0 / 30.0, PlaneField(32), 0.0);
    double energy = 0.0;
    const OscillatorState& s = leaves.state();
    for (int a = 0; a < 32; ++a)
      for (int b = 0; b < 32; ++b) {
        const auto m = static_cast<std::size_t>(a * 32 + b);
        const double wave = 2.0 * PI / 4.0 * 0.4;
        const double k2 = std::pow(waveNumber(a, 32), 2) + std::pow(waveNumber(b, 32), 2);
        energy += s.rate.u[m] * s.rate.u[m] + s.rate.v[m] * s.rate.v[m] +
                  (omega * omega + wave * wave * k2) *
                      (s.amplitude.u[m] * s.amplitude.u[m] + s.amplitude.v[m] * s.amplitude.v[m]);
      }
    ASSERT_LE(energy, last * (1.0 + 1e-12)) << i;
    last = energy;
  }
}

/// Largest step for which Verlet's motion from noise stays bounded, by bisection.
double largestStableStep(const WaveLaw& law, int size) {
  double low = 1e-4, high = 10.0;
  while (high / low > 1.001) {
    const double dt = std::sqrt(low * high);
    VerletStep verlet(law, size);
    PlaneField amplitude = noiseField(size, 3), rate(size);
    const PlaneField force(size);
    for (int i = 0; i < 3000 && rootMeanSquare(amplitude) < 1e6; ++i)
      verlet.step(dt, force, amplitude, rate);
    (rootMeanSquare(amplitude) < 1e3 ? low : high) = dt;
  }
  return low;
}

// S3-12: Courant's 1 / sqrt(2), less with a stiffness of the leaves' own; damping changes nothing.
TEST(VerletStep, HasTheBoundaryOfTheory) {
  for (const WaveLaw& law : {WaveLaw{1e-6, 0.0, 1.0, 4.0}, WaveLaw{6.0, 0.0, 0.5, 4.0},
                             WaveLaw{6.0, 0.3, 0.5, 4.0}, WaveLaw{12.0, 0.0, 0.1, 4.0}}) {
    const double theory = VerletStep(law, 16).longestStep();
    EXPECT_NEAR(largestStableStep(law, 16) / theory, 1.0, 0.01) << law.omega << ", " << law.speed;
  }
  EXPECT_NEAR(VerletStep({1e-6, 0.0, 1.0, 4.0}, 16).longestStep() / 0.25, std::sqrt(0.5), 1e-6);
}

// S3-12: Verlet is never run beyond its limit.
TEST(Oscillator, DividesAStepThatIsTooLongForVerlet) {
  OscillatorSettings settings = with("verlet");
  settings.speed = 5.0;
  Oscillator leaves(settings, 64, 4.0);
  for (int i = 0; i < 100; ++i) leaves.advance(0.2, smoothFlow(64, 4), 0.0);
  EXPECT_EQ(leaves.divided(), 100U);
  EXPECT_LT(rootMeanSquare(leaves.motion()), 1.0);
  leaves.advance(1e5, smoothFlow(64, 4), 0.0);
  EXPECT_LT(rootMeanSquare(leaves.motion()), 1.0);
  OscillatorSettings exact = with("exact");
  exact.speed = 5.0;
  Oscillator other(exact, 64, 4.0);
  other.advance(1e5, smoothFlow(64, 4), 0.0);
  EXPECT_LT(relativeError(leaves.motion(), other.motion()), 0.01);  // both at rest by then
}

// N9: "a longer step is divided to 0.95 of it": at the limit and a touch beyond.
TEST(Oscillator, DividesJustBeyondTheLimitOfVerletAndNotBefore) {
  OscillatorSettings settings = with("verlet");
  settings.speed = 5.0;
  const WaveLaw law{2.0 * PI * settings.frequency, settings.damping, settings.speed, 4.0};
  const double longest = VerletStep(law, 64).longestStep();
  for (const double ratio : {0.94, 1.01}) {
    Oscillator leaves(settings, 64, 4.0);
    leaves.advance(ratio * longest, smoothFlow(64, 4), 0.0);
    EXPECT_EQ(leaves.divided(), ratio > 1.0 ? 1U : 0U) << ratio;
  }
}

// N6, and bad input.
TEST(Oscillator, IsRestoredToTheSameBitsAndRejectsInvalidStates) {
  for (const char* integrator : {"exact", "verlet"}) {
    Oscillator first(with(integrator), 32, 4.0), second(with(integrator), 32, 4.0);
    first.advance(0.5, smoothFlow(32, 5), 1.0);
    second.restore(first.state());
    EXPECT_EQ(hashOf(first.motion()), hashOf(second.motion()));
    for (Oscillator* leaves : {&first, &second}) leaves->advance(0.1, smoothFlow(32, 6), 0.0);
    EXPECT_EQ(hashOf(first.motion()), hashOf(second.motion()));
    OscillatorState bad = first.state();
    bad.rate.u[7] = std::nan("");
    EXPECT_THROW(first.restore(bad), InvalidInput);
    bad.rate = PlaneField(16);
    EXPECT_THROW(first.restore(bad), InvalidInput);
  }
  Oscillator still(with("exact"), 32, 4.0);
  for (const double dt : {0.0, -1.0, std::nan("")}) still.advance(dt, smoothFlow(32, 1), 1.0);
  EXPECT_EQ(rootMeanSquare(still.motion()), 0.0);
  OscillatorSettings bad;
  bad.frequency = 0.0;
  EXPECT_THROW(Oscillator(bad, 32, 4.0), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim::canopy
