// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/walking_speed.h"

#include <gtest/gtest.h>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

// S2-34
TEST(Motion, SpeedFallsUphillAndOnSteepWaysDown) {
  EXPECT_NEAR(slopeFactor(0.0), 1.0, 1e-15);
  EXPECT_GT(slopeFactor(-0.05), 1.0);
  double before = slopeFactor(0.0);
  for (double slope = 0.02; slope < 1.0; slope += 0.02) {
    EXPECT_LT(slopeFactor(slope), before);
    before = slopeFactor(slope);
  }
  EXPECT_LT(slopeFactor(-0.5), slopeFactor(-0.1));
}

//   step ->  | limit at 0.3 m: slides along it
TEST(Motion, StepsSlideAlongWhatTheyMayNotCross) {
  std::array<Limit, View::MOST> limits;
  limits[0] = {{1.0, 0.0}, 0.3, 0.3};
  const Point step = safeStep({1.0, 0.5}, limits, 1, 10.0);
  EXPECT_NEAR(step.x, 0.3, 1e-12);
  EXPECT_NEAR(step.y, 0.5, 1e-12);
  limits[1] = {{0.0, 1.0}, 0.2, 0.2};
  EXPECT_NEAR(safeStep({1.0, 0.5}, limits, 2, 10.0).y, 0.2, 1e-12);
  EXPECT_NEAR(length(safeStep({1.0, 0.5}, limits, 2, 0.1)), 0.1, 1e-12);
}

TEST(Motion, NoStepPassesAHardLimit) {
  const Random random(3);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Random own = random.child(i);
    std::array<Limit, View::MOST> limits;
    for (std::uint64_t k = 0; k < 8; ++k) {
      const SinCos at = sinCosTurns(own.uniform(3 * k));
      const double hard = own.uniform(3 * k + 1, 0.0, 1.0);
      limits[k] = {{at.cos, at.sin}, own.uniform(3 * k + 2, -0.5, hard), hard};
    }
    const Point step =
        safeStep({own.uniform(30, -9.0, 9.0), own.uniform(31, -9.0, 9.0)}, limits, 8, 5.0);
    for (const Limit& limit : limits) ASSERT_LE(dot(step, limit.normal), limit.hard + 1e-12);
  }
}

// S2-34: position and heading change smoothly whatever is commanded.
TEST(Motion, HeadingAndSpeedChangeAtBoundedRates) {
  CrowdSettings settings;
  Walker walker;
  constexpr double DT = 1.0 / 60.0;
  for (int i = 0; i < 300; ++i) {
    const Point direction = i / 50 % 2 ? Point{-1.0, 0.0} : Point{0.0, 1.0};
    const Walker before = walker;
    walker.velocity = followed(walker, frontOf(walker), {direction, 1.35}, settings, DT);
    turnTowards(direction, frontOf(walker), settings, DT, walker);
    EXPECT_LE(length(walker.velocity - before.velocity), settings.acceleration * DT + 1e-12);
    double turn = walker.heading - before.heading;
    turn -= 2.0 * PI * std::floor(turn / (2.0 * PI) + 0.5);
    EXPECT_LE(std::fabs(turn), settings.turn_rate * DT + 1e-12);
    EXPECT_LE(std::fabs(walker.heading), PI + 1e-12);
  }
}

TEST(Motion, WalkersInOnePlaceAgreeHowToPart) {
  View view;
  view.count = 1;
  view.sights[0] = {Seen::WALKER, 0, -0.5, -0.5, {}, {}, nullptr, {}, 0.25};
  std::array<Limit, View::MOST> one, other;
  const CrowdSettings settings;
  view.sights[0].index = 7;
  limitsOf(3, view, settings, 0.1, one);
  view.sights[0].index = 3;
  limitsOf(7, view, settings, 0.1, other);
  EXPECT_NEAR(one[0].normal.x, -other[0].normal.x, 1e-15);
  EXPECT_NEAR(one[0].normal.y, -other[0].normal.y, 1e-15);
  EXPECT_LT(one[0].wanted, 0.0);
}

}  // namespace
}  // namespace vegetation_sim::crowd
