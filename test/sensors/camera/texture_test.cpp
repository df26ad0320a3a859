// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::scan {
namespace {

TEST(Texture, NoiseHasTheValuesOfTheLatticeAndIsContinuous) {
  for (int x = -3; x < 3; ++x)
    for (int y = -3; y < 3; ++y)
      EXPECT_NEAR(smoothNoise(Vec3(x, y, -1.0), 7), shareOf({x, y, -1}, 7), 1e-9);
  double most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 place(0.01 * i - 20.0, 3.3 - 0.004 * i, 0.3);
    const double here = smoothNoise(place, 7);
    EXPECT_TRUE(here >= 0.0 && here <= 1.0);
    most = std::max(most, std::fabs(smoothNoise(place + Vec3(0.01, 0.0, 0.0), 7) - here));
  }
  EXPECT_LT(most, 0.016);  // The slope of 3x^2 - 2x^3 is at most 1.5.
  EXPECT_GT(most, 0.003);
}

TEST(Texture, FarPlacesAndKeysGiveOtherValues) {
  const Vec3 place(0.3, 0.4, 0.5);
  EXPECT_NE(smoothNoise(place, 1), smoothNoise(place, 2));
  EXPECT_NE(fractalNoise(place, 3, 1), fractalNoise(place + Vec3(50.0, 0.0, 0.0), 3, 1));
  EXPECT_TRUE(std::isfinite(smoothNoise(Vec3(1e30, -1e30, 0.0), 1)));
}

}  // namespace
}  // namespace vegetation_sim::scan
