// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/beam_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::scan {
namespace {

TEST(BeamShape, RaysFillTheConeEvenly) {
  const Vec3 axis = Vec3(0.6, -0.3, 0.2).normalized();
  for (const int samples : {1, 7, 19, 37}) {
    const BeamPattern pattern({0.02, samples, 0.5});
    ASSERT_EQ(pattern.rays(), samples);
    EXPECT_EQ(pattern.direction(axis, 0), axis);
    Vec3 sum = Vec3::Zero();
    double squares = 0.0;
    for (int i = 0; i < samples; ++i) {
      const Vec3 ray = pattern.direction(axis, i);
      EXPECT_NEAR(length(ray), 1.0, 1e-14);
      const double angle = length(cross(axis, ray));
      EXPECT_LT(angle, 0.01);
      sum += ray;
      squares += angle * angle / samples;
    }
    EXPECT_LT(length(cross(axis, sum)) / samples, 1e-12);
    // The mean square of the distance from the middle of a disc is half of that of its edge; one
    // ray in the middle has none of it.
    if (samples > 1) {
      EXPECT_NEAR(squares / (0.01 * 0.01), 0.5, 0.5 / samples);
    }
  }
}

TEST(BeamShape, AllAxesHaveRays) {
  const BeamPattern pattern({0.01, 7, 0.5});
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0)})
    for (int i = 1; i < 7; ++i)
      EXPECT_NEAR(length(cross(axis, pattern.direction(axis, i))),
                  std::sin(std::atan(0.005 * std::sqrt(4.0 / 7.0))), 1e-7);
}

TEST(BeamShape, OtherNumbersOfRaysAreRejected) {
  for (const int samples : {2, 6, 18, 36}) {
    Faults faults;
    check(BeamShape{0.01, samples, 0.5}, "lidar/", faults);
    EXPECT_EQ(faults.text(),
              "lidar/samples = " + std::to_string(samples) + " is none of 1, 7, 19, 37");
  }
}

}  // namespace
}  // namespace vegetation_sim::scan
