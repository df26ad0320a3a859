// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/daylight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::scan {
namespace {

TEST(Daylight, ALowSunIsWeakerAndRedder) {
  Weatherlight low, high;
  low.sun_elevation = 0.1;
  high.sun_elevation = 1.2;
  const Daylight evening(low), noon(high);
  EXPECT_NEAR(noon.toSun().z(), std::sin(1.2), 1e-12);
  EXPECT_NEAR(length(noon.toSun()), 1.0, 1e-12);
  EXPECT_LT(evening.sun().x(), noon.sun().x());
  EXPECT_GT(evening.sun().x() / evening.sun().z(), 2.0 * noon.sun().x() / noon.sun().z());
}

// Koschmieder: at the visibility a black object has a contrast of 2 % with the horizon.
TEST(Daylight, FogLeavesTwoPercentOfContrastAtItsVisibility) {
  Weatherlight light;
  light.fog_visibility = 800.0;
  const Daylight fog(light);
  const Vec3 horizon = fog.through(Vec3::Zero(), 1e9), black = fog.through(Vec3::Zero(), 800.0);
  EXPECT_NEAR(1.0 - black.y() / horizon.y(), 0.02, 1e-4);
  light.fog_visibility = 0.0;
  const Vec3 clear = Daylight(light).through(Vec3(0.1, 0.2, 0.3), 1e4);
  EXPECT_NEAR((clear - Vec3(0.1, 0.2, 0.3)).norm(), 0.0, 1e-15);
}

TEST(Daylight, TheSunIsTheBrightestPlaceOfTheSky) {
  const Daylight day{Weatherlight()};
  const double sun = day.skyTowards(day.toSun()).y();
  EXPECT_GT(sun, 5.0);
  const Vec3 aside(-day.toSun().x(), -day.toSun().y(), day.toSun().z());
  EXPECT_LT(day.skyTowards(aside).y(), 1.5);
}

}  // namespace
}  // namespace vegetation_sim::scan
