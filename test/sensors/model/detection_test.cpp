// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/detection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::scan {
namespace {

TEST(Detection, HalfOfTheEchoesOfADarkTargetReturnAtTheDetectionRange) {
  const Detection sensor{0.0, 40.0};
  EXPECT_NEAR(detectionProbability(sensor, 0.1, 1.0, 40.0), 0.5, 1e-12);
  // Light decreases with the square of the range: eight times brighter, sqrt(8) times farther.
  EXPECT_NEAR(detectionProbability(sensor, 0.8, 1.0, 40.0 * std::sqrt(8.0)), 0.5, 1e-12);
  EXPECT_NEAR(detectionProbability(sensor, 0.8, 0.125, 40.0), 0.5, 1e-12);
  EXPECT_NEAR(detectionProbability(sensor, 0.2, 1.0, 40.0), 16.0 / 17.0, 1e-12);
}

TEST(Detection, ProbabilityFallsWithRangeIncidenceAndExtinction) {
  const Detection sensor{0.0, 40.0};
  double last = 1.0;
  for (double range = 5.0; range < 100.0; range += 5.0) {
    const double now = detectionProbability(sensor, 0.3, 1.0, range);
    EXPECT_LT(now, last);
    EXPECT_LT(detectionProbability(sensor, 0.3 * std::cos(1.2), 1.0, range), now);
    EXPECT_LT(detectionProbability(sensor, 0.3, 0.5, range), now);
    last = now;
  }
  EXPECT_EQ(detectionProbability(sensor, 0.0, 1.0, 10.0), 0.0);
  EXPECT_EQ(detectionProbability(sensor, 0.3, 1.0, 0.0), 1.0);
}

TEST(Detection, WithoutARangeOnlyTheAirAndDropoutLoseEchoes) {
  EXPECT_EQ(detectionProbability({}, 0.001, 1.0, 400.0), 1.0);
  EXPECT_EQ(detectionProbability({}, 0.001, 0.3, 400.0), 0.3);
  EXPECT_NEAR(detectionProbability({0.2, 0.0}, 0.5, 0.5, 10.0), 0.4, 1e-15);
  EXPECT_NEAR(detectionProbability({0.2, 40.0}, 0.1, 1.0, 40.0), 0.4, 1e-15);
}

}  // namespace
}  // namespace vegetation_sim::scan
