// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Every source is twice differentiable in time and space, which the compensated forcing of E1
// needs. A third difference of step h falls 8 times when h is halved if the second derivative is
// continuous, 4 times if it jumps, and twice if the first one does.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scenes/wind/wind_examples.h"
#include "wind/fade.h"
#include "wind/trajectory.h"

namespace vegetation_sim::wind {
namespace {

double largestThirdDifference(const std::function<Vec3(double)>& f, double from, double to,
                              double h) {
  double largest = 0.0;
  for (double x = from; x < to; x += h)
    largest =
        std::max(largest, length(f(x + 3.0 * h) - 3.0 * f(x + 2.0 * h) + 3.0 * f(x + h) - f(x)));
  return largest;
}

double fallWhenHalved(const std::function<Vec3(double)>& f, double from, double to, double h) {
  return largestThirdDifference(f, from, to, h) / largestThirdDifference(f, from, to, 0.5 * h);
}

constexpr double C2 = 6.5;  // between the 4 of a jumping second derivative and 8

class EveryKind : public testing::TestWithParam<int> {};

TEST_P(EveryKind, IsTwiceDifferentiableInTime) {  // E1, S1-W1
  const Field field({oneOfEach()[static_cast<std::size_t>(GetParam())]});
  for (const Vec3& position : {Vec3(1.0, 1.0, 1.0), Vec3(9.0, -4.0, 0.0), Vec3(11.0, 6.0, 3.0)}) {
    const auto speed = [&](double t) { return field.velocity(position, at(t)); };
    EXPECT_GT(fallWhenHalved(speed, 0.0, 42.0, 1.0 / 256), C2) << position.transpose();
  }
}

TEST_P(EveryKind, IsTwiceDifferentiableInSpace) {  // E1, S1-W1
  const Field field({oneOfEach()[static_cast<std::size_t>(GetParam())]});
  const Instant instant = field.at(at(7.3));
  const Vec3 centre = instant.terms.empty() ? Vec3(0.0, 0.0, 0.0) : instant.terms[0].centre;
  for (const Vec3& step : {Vec3(1.0, 0.0, 0.0), Vec3(0.6, 0.8, 0.0), Vec3(0.0, 0.6, 0.8)}) {
    for (const Vec3& beside : {Vec3(0.0, 0.0, 0.0), Vec3(0.7, 0.0, 0.2)}) {
      const auto speed = [&](double x) { return instant.velocity(centre + beside + step * x); };
      EXPECT_GT(fallWhenHalved(speed, -60.0, 12.0, 1.0 / 128), C2) << step.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, testing::Range(0, 7), [](const auto& info) {
  return kindNames()[static_cast<std::size_t>(info.param)];
});

TEST(PrintedDisk, HasAKinkThatTheMeasureSees) {  // E1: why the printed envelope is not the default
  const Instant instant = Field({printedDisk()}).at(at(0.3));
  const auto speed = [&](double x) { return instant.velocity(Vec3(x, 0.0, 0.0)); };
  EXPECT_LT(fallWhenHalved(speed, -12.0, 12.0, 1.0 / 128), 2.5);
}

TEST(Fade, RunsFromNothingToFullAndBack) {  // S1-W1
  Primitive p = example(Kind::DISK);
  p.t_on = at(10.0);
  p.t_off = at(20.0);
  p.fade_in = 2.0;
  p.fade_out = 4.0;
  EXPECT_EQ(fade(p, at(9.0)), 0.0);
  EXPECT_EQ(fade(p, at(11.0)), 0.5);
  EXPECT_EQ(fade(p, at(14.0)), 1.0);
  EXPECT_EQ(fade(p, at(18.0)), 0.5);
  EXPECT_EQ(fade(p, at(20.0)), 0.0);
  EXPECT_EQ(fade(p, at(21.0)), 0.0);
}

TEST(Fade, OfNoLengthIsAHardEdge) {  // S1-W1
  Primitive p = example(Kind::DISK);
  p.t_on = at(10.0);
  p.t_off = at(20.0);
  EXPECT_EQ(fade(p, at(10.0) - 1), 0.0);
  EXPECT_EQ(fade(p, at(10.0)), 1.0);
  EXPECT_EQ(fade(p, at(20.0) - 1), 1.0);
  EXPECT_EQ(fade(p, at(20.0)), 0.0);
}

}  // namespace
}  // namespace vegetation_sim::wind
