// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

// Inverts the curve of sRGB.
double signalOf(double value) {
  const double x = value / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

TEST(Exposure, SignalsFollowTheCurveOfSrgb) {
  EXPECT_EQ(encode(-0.1), 0);
  EXPECT_EQ(encode(0.0), 0);
  EXPECT_EQ(encode(0.18), 118);  // the grey card
  EXPECT_EQ(encode(0.5), 188);
  EXPECT_EQ(encode(1.0), 255);
  EXPECT_EQ(encode(7.0), 255);
  for (int value = 0; value < 256; ++value) EXPECT_EQ(encode(signalOf(value)), value);
}

TEST(Exposure, FactorMultipliesTheRadiance) {
  Exposure exposure;
  const Rgb8 once = develop(exposure, Vec3(0.1, 0.2, 0.4), nullptr);
  exposure.factor = 4.0;
  const Rgb8 more = develop(exposure, Vec3(0.025, 0.05, 0.1), nullptr);
  EXPECT_EQ(once.red, more.red);
  EXPECT_EQ(once.green, more.green);
  EXPECT_EQ(once.blue, more.blue);
  EXPECT_EQ(once.green, encode(0.2));
}

// The law: variance read^2 + shot^2 s of a signal s. Values are inverted to signals; a level near
// 0.5 is 0.009 wide, whose rounding adds 0.009^2/12.
TEST(Exposure, NoiseHasTheMeanAndVarianceOfItsLaw) {
  Exposure exposure;
  exposure.read_noise = 0.03;
  exposure.shot_noise = 0.06;
  constexpr int PIXELS = 40000;
  for (const double signal : {0.3, 0.5}) {
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t i = 0; i < PIXELS; ++i) {
      const RayRandom random({3, 7, 2}, i);
      const double one = signalOf(develop(exposure, Vec3(0.1, signal, 0.7), &random).green);
      sum += one;
      squares += one * one;
    }
    const double mean = sum / PIXELS, variance = squares / PIXELS - mean * mean;
    const double law = 0.03 * 0.03 + 0.06 * 0.06 * signal + 0.009 * 0.009 / 12.0;
    // Four standard deviations of the mean and of the variance of a normal distribution, and the
    // 0.1 % of the bias of the rounding on a curve.
    EXPECT_NEAR(mean, signal, 4.0 * std::sqrt(law / PIXELS) + 0.001 * signal);
    EXPECT_NEAR(variance, law, 4.0 * law * std::sqrt(2.0 / PIXELS) + 0.01 * law);
  }
}

TEST(Exposure, NoiseOfChannelsPixelsAndTicksIsIndependent) {
  Exposure exposure;
  exposure.read_noise = 0.1;
  double channels = 0.0, pixels = 0.0, ticks = 0.0;
  constexpr int PIXELS = 20000;
  const auto error = [&](std::uint64_t tick, std::uint64_t pixel, bool blue) {
    const RayRandom random({1, tick, 2}, pixel);
    const Rgb8 out = develop(exposure, Vec3(0.5, 0.5, 0.5), &random);
    return (signalOf(blue ? out.blue : out.red) - 0.5) / 0.1;
  };
  for (std::uint64_t i = 0; i < PIXELS; ++i) {
    const double one = error(5, i, false);
    channels += one * error(5, i, true) / PIXELS;
    pixels += one * error(5, i + 1, false) / PIXELS;
    ticks += one * error(6, i, false) / PIXELS;
  }
  for (const double correlation : {channels, pixels, ticks})
    EXPECT_NEAR(correlation, 0.0, 4.0 / std::sqrt(PIXELS));
}

}  // namespace
}  // namespace vegetation_sim::scan
