// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/gauss_markov.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/sampling/gust_spectrum.h"

namespace vegetation_sim::wind {
namespace {

constexpr double TIME_SCALE = 2.0;  // [s]

Primitive gaussMarkov() {
  Primitive p = example(Kind::GAUSS_MARKOV, "restless");
  p.velocity = Vec3(3.0, 4.0, 0.0);  // 5 m/s along (0.6, 0.8)
  p.turbulence = 0.3;
  p.time_scale = TIME_SCALE;
  p.radius = 20.0;
  return p;
}

double along(const Vec3& air) {
  return 0.6 * air.x() + 0.8 * air.y();
}

// S1-W1: samples are those of the process: variance 1, correlation exp(-t / T) at any distance,
// also across the ends of cells.
TEST(GaussMarkovProcess, HasTheStatedCorrelation) {
  constexpr std::array<std::int64_t, 6> APART{0, 1, 8, 32, 64, 160};
  constexpr int SEEDS = 40, LENGTH = 400;  // samples 16 apart: 200 scales per seed
  for (const std::int64_t apart : APART) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < SEEDS; ++seed) {
      const GaussMarkovProcess process{Random(seed)};
      for (std::int64_t i = -LENGTH / 2; i < LENGTH / 2; ++i)
        sum += process.sample(16 * i) * process.sample(16 * i + apart);
    }
    // 8000 scales have some 8000 independent products of deviation 1 to sqrt 2: three deviations.
    const double expected =
        exponential(-static_cast<double>(apart) / GaussMarkovProcess::PER_SCALE);
    EXPECT_NEAR(sum / (SEEDS * LENGTH), expected, 0.048) << apart;
  }
}

// S1-W1: neighbours differ as those of the process: the variance of a step is 2 (1 - exp(-h / T)).
TEST(GaussMarkovProcess, HasTheStatedSteps) {
  double sum = 0.0, fourth = 0.0;
  constexpr int STEPS = 40000;
  const GaussMarkovProcess process{Random(5)};
  for (std::int64_t i = 0; i < STEPS; ++i) {
    const double step = process.sample(i + 1) - process.sample(i);
    sum += step * step;
    fourth += step * step * step * step;
  }
  const double variance = 2.0 * (1.0 - exponential(-1.0 / GaussMarkovProcess::PER_SCALE));
  EXPECT_NEAR(sum / STEPS / variance, 1.0, 0.03);                 // deviation sqrt(2 / 40000)
  EXPECT_NEAR(fourth / STEPS / (variance * variance), 3.0, 0.2);  // of a normal distribution
}

// S1-W1: any order of evaluation gives the same bits, before the epoch too.
TEST(GaussMarkov, IsAPureFunctionOfTimeSeedAndName) {
  const Field field({gaussMarkov()}, 3), same({gaussMarkov()}, 3), other({gaussMarkov()}, 4);
  Primitive renamed = gaussMarkov();
  renamed.name = "another";
  for (const double t : {90.0, 3.0, 1e6, 0.5, 41.0}) {
    const Vec3 air = field.velocity(Vec3::Zero(), at(t));
    EXPECT_EQ(air, same.velocity(Vec3::Zero(), at(t))) << t;
    EXPECT_NE(air, other.velocity(Vec3::Zero(), at(t))) << t;
    EXPECT_NE(air, Field({renamed}, 3).velocity(Vec3::Zero(), at(t))) << t;
  }
  Primitive late = gaussMarkov();
  late.epoch = at(100.0);
  EXPECT_NE(Field({late}, 3).velocity(Vec3::Zero(), at(20.0)),
            Field({late}, 3).velocity(Vec3::Zero(), at(21.0)));
}

TEST(GaussMarkov, HasTheStatedMeanAndRms) {  // S1-W1
  double mean = 0.0, lateral = 0.0, square = 0.0, cross = 0.0, rise = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Field field({gaussMarkov()}, seed);
    for (double t = 10.0; t < 410.0; t += 1.0, ++count) {  // 200 scales
      const Vec3 air = field.velocity(Vec3::Zero(), at(t));
      const double aside = -0.8 * air.x() + 0.6 * air.y();
      mean += along(air), lateral += aside;
      square += (along(air) - 5.0) * (along(air) - 5.0);
      cross += aside * aside, rise += air.z() * air.z();
    }
  }
  // The variance of a mean of 8000 scales is 2 sigma^2 / 8000, its deviation 1.6 % of sigma; that
  // of a variance sigma^2 sqrt(2 / 8000), so 0.8 % of an rms.
  EXPECT_NEAR(mean / count, 5.0, 3.0 * 0.016 * 1.5);
  EXPECT_NEAR(lateral / count, 0.0, 3.0 * 0.016 * 1.2);
  EXPECT_NEAR(std::sqrt(square / count) / 1.5, 1.0, 0.024);
  EXPECT_NEAR(std::sqrt(cross / count) / 1.2, 1.0, 0.024);
  EXPECT_NEAR(std::sqrt(rise / count) / 0.75, 1.0, 0.024);
}

/// Returns the density [(m/s)^2/Hz] near f [Hz], over some independent records.
double density(double f, double duration, double rate) {
  constexpr int SEEDS = 300;
  double sum = 0.0;
  const int n = static_cast<int>(duration * rate);
  for (std::uint64_t seed = 0; seed < SEEDS; ++seed) {
    const Field field({gaussMarkov()}, seed);
    double re = 0.0, im = 0.0;
    for (int i = 0; i < n; ++i) {
      const double window = 1.0 - sinCosTurns(static_cast<double>(i) / n).cos;  // Hann's
      const double air = along(field.velocity(Vec3::Zero(), at(20.0 + i / rate))) - 5.0;
      const SinCos turn = sinCosTurns(f * i / rate);
      re += window * air * turn.cos;
      im += window * air * turn.sin;
    }
    sum += 2.0 * (re * re + im * im) / (1.5 * n * rate);  // 1.5: mean square of the window
  }
  return sum / SEEDS;
}

// S1-W1: the spectrum is the Lorentzian, from far below to ten times its corner 1 / (2 pi T).
// Beyond, the spline has less: sinc^8, 13 % at f = 2 / T.
TEST(GaussMarkov, HasTheSpectrumOfALorentzian) {
  for (const double turns : {0.05, 0.16, 0.5, 1.6}) {  // f T
    const double f = turns / TIME_SCALE;
    const double duration = std::max(4.0 / f, 6.0 * TIME_SCALE), rate = 16.0;
    const double measured = density(f, duration, rate);
    const double stated = lorentzianDensity(f, 1.5, TIME_SCALE);
    std::printf("%.3f Hz: %.3f, stated %.3f (m/s)^2/Hz\n", f, measured, stated);
    // A density of 300 records has a deviation of 1 / sqrt(300), 6 %; the window smooths the curve.
    EXPECT_NEAR(measured / stated, 1.0, 0.2) << f;
  }
  double integral = 0.0;
  for (double f = 1e-5; f < 1e4; f *= 1.001)
    integral += lorentzianDensity(f, 1.5, TIME_SCALE) * f * 0.001;
  EXPECT_NEAR(integral, 1.5 * 1.5, 0.01);
}

TEST(GaussMarkov, EndsAtItsRadiusAndFollowsItsCentre) {  // S1-W1
  Primitive p = gaussMarkov();
  p.trajectory = {{at(0.0), Vec3(0.0, 0.0, 0.0)}, {at(10.0), Vec3(100.0, 0.0, 0.0)}};
  const Field field({p}, 3);
  EXPECT_EQ(field.velocity(Vec3(21.0, 0.0, 0.0), at(0.0)), Vec3(Vec3::Zero()));
  EXPECT_GT(length(field.velocity(Vec3(100.0, 0.0, 0.0), at(10.0))), 0.5);
  EXPECT_EQ(field.velocity(Vec3(0.0, 0.0, 0.0), at(10.0)), Vec3(Vec3::Zero()));
}

// S1-22: fewer than one of a hundred samples exceeds the bound, and all of the variance counts for
// the response of plants.
TEST(GaussMarkov, IsRarelyAboveItsBound) {
  int passed = 0, count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Field field({gaussMarkov()}, seed);
    for (double t = 0.0; t < 400.0; t += 2.0, ++count) {
      const Instant instant = field.at(at(t));
      EXPECT_NEAR(instant.speedBound(Vec3::Zero(), 1.0),
                  5.0 + 3.0 * 1.5 * std::sqrt(1.0 + 0.64 + 0.25), 1e-9);
      passed += length(instant.velocity(Vec3::Zero())) > instant.speedBound(Vec3::Zero(), 1.0);
    }
  }
  EXPECT_LT(passed, count / 100);
  const GustSpectrumField spectrum(Field({gaussMarkov()}), at(5.0));
  EXPECT_FALSE(spectrum.hasDisks());
  const GustSpectrum gusts = spectrum.at(Vec3::Zero(), 1.0);
  double square = 0.0;
  for (const auto& row : gusts.power)
    for (const double part : row) square += part;
  const double peak = GustSpectrumField::PEAK * 1.5 * std::sqrt(1.0 + 0.64 + 0.25);
  EXPECT_NEAR(square, peak * peak, 1e-9);
  EXPECT_NEAR(gusts.peak, 5.0 + peak, 1e-9);
  EXPECT_EQ(spectrum.at(Vec3(50.0, 0.0, 0.0), 1.0).peak, 0.0);
}

}  // namespace
}  // namespace vegetation_sim::wind
