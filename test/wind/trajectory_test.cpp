// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/wind/wind_examples.h"

namespace vegetation_sim::wind {
namespace {

const std::vector<Waypoint> BEND = {{at(1.0), Vec3(0.0, 0.0, 0.0)},
                                    {at(2.0), Vec3(3.0, 1.0, 0.0)},
                                    {at(4.5), Vec3(2.0, 4.0, 1.0)},
                                    {at(5.0), Vec3(0.0, 5.0, 1.0)}};

TEST(Trajectory, WithoutPointsStandsAtTheOrigin) {  // S1-17
  EXPECT_EQ(Trajectory(std::vector<Waypoint>{}).at(at(3.0)), Vec3(Vec3::Zero()));
}

TEST(Trajectory, OfOnePointStandsThere) {  // S1-17
  const Trajectory path({{at(5.0), Vec3(1.0, 2.0, 3.0)}});
  for (const double t : {0.0, 5.0, 1e6}) EXPECT_EQ(path.at(at(t)), Vec3(1.0, 2.0, 3.0));
}

TEST(Trajectory, OfTwoPointsIsStraightWithoutEnd) {  // S1-17
  const Trajectory path({{at(1.0), Vec3(0.0, 0.0, 0.0)}, {at(3.0), Vec3(2.0, -4.0, 0.0)}});
  for (const double t : {-2.0, 1.0, 2.0, 3.0, 10.0})
    EXPECT_LT(length(path.at(at(t)) - Vec3(t - 1.0, -2.0 * (t - 1.0), 0.0)), 1e-12) << t;
}

TEST(Trajectory, PassesThroughItsPoints) {  // S1-17
  const Trajectory path(BEND);
  for (const Waypoint& point : BEND)
    EXPECT_LT(length(path.at(point.stamp) - point.position), 1e-12);
}

TEST(Trajectory, KeepsVelocityAndAccelerationAtItsPoints) {  // E1
  const Trajectory path(BEND);
  const double h = 1e-3;
  const auto velocity = [&](Nanoseconds t) -> Vec3 {
    return (path.at(t + at(h)) - path.at(t - at(h))) / (2.0 * h);
  };
  for (const Waypoint& point : BEND) {
    const Nanoseconds before = point.stamp - at(3 * h), after = point.stamp + at(3 * h);
    const Vec3 bend_before = (velocity(before + at(h)) - velocity(before - at(h))) / (2.0 * h);
    const Vec3 bend_after = (velocity(after + at(h)) - velocity(after - at(h))) / (2.0 * h);
    // 6 h times the largest third derivative of this path, 80 m/s^3.
    EXPECT_LT(length(bend_after - bend_before), 6 * h * 80.0);
    EXPECT_LT(length(velocity(after) - velocity(before)), 6 * h * 15.0);
  }
}

TEST(Trajectory, BoundsItsLevelAccelerationBetweenTwoStamps) {
  const Trajectory path(BEND);
  const double h = 1e-3;
  for (double from = 0.0; from < 6.0; from += 0.37)
    for (double to = from; to < 6.5; to += 0.41) {
      const double bound = path.accelerationBound(at(from), at(to));
      for (double t = from; t <= to; t += 0.05) {
        const Vec3 bend =
            (path.at(at(t + h)) - 2.0 * path.at(at(t)) + path.at(at(t - h))) / (h * h);
        // h times the third derivative, and the rounding of positions
        EXPECT_LE(std::hypot(bend.x(), bend.y()), bound + h * 80.0 + 1e-8) << t;
      }
    }
  EXPECT_EQ(path.accelerationBound(at(5.0), at(9.0)), 0.0);
  EXPECT_EQ(path.accelerationBound(at(0.0), at(1.0)), 0.0);
  EXPECT_EQ(Trajectory().accelerationBound(at(0.0), at(9.0)), 0.0);
}

TEST(Trajectory, IsTheSameAtUnixTimes) {  // N2
  const Nanoseconds shift = 1767225600LL * NANOSECONDS_PER_SECOND + 123456789;
  std::vector<Waypoint> moved = BEND;
  for (Waypoint& point : moved) point.stamp += shift;
  const Trajectory early(BEND), late(moved);
  for (double t = 0.0; t < 7.0; t += 0.0137) EXPECT_EQ(early.at(at(t)), late.at(at(t) + shift));
}

TEST(Trajectory, OfUnevenlySpacedPointsOnALineStaysOnIt) {  // S1-17
  std::vector<Waypoint> points;
  for (const double t : {0.0, 0.001, 0.5, 0.6, 7.0, 7.1, 30.0})
    points.push_back({at(t), Vec3(2.0 * t, -t, 0.5 * t)});
  const Trajectory path(points);
  for (double t = -1.0; t < 32.0; t += 0.111)
    EXPECT_LT(length(path.at(at(t)) - Vec3(2.0 * t, -t, 0.5 * t)), 1e-9) << t;
}

}  // namespace
}  // namespace vegetation_sim::wind
