// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/sensor_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

Pose poseAt(const Vec3& place, double yaw) {
  Pose out;
  out.position = place;
  const SinCos half = sinCos(0.5 * yaw);
  out.orientation = {half.cos, 0.0, 0.0, half.sin};
  return out;
}

TEST(SensorPath, APoseStandsStill) {
  const SensorPath path = poseAt(Vec3(1, 2, 3), 0.4);
  EXPECT_FALSE(path.moves());
  EXPECT_EQ(path.seconds(), 0.0);
  EXPECT_EQ(path.at(0.0).position, Vec3(1, 2, 3));
  EXPECT_EQ(path.at(5.0).orientation.z, path.begin().orientation.z);
}

TEST(SensorPath, VelocityAndAngularVelocityAreConstant) {
  const SensorPath path(poseAt(Vec3(1, 0, 0), 0.3), poseAt(Vec3(3, 1, 0), 2.3), 0.1);
  ASSERT_TRUE(path.moves());
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const Pose got = path.at(0.1 * share);
    const Pose wanted = poseAt(Vec3(1 + 2 * share, share, 0), 0.3 + 2.0 * share);
    EXPECT_LT(length(got.position - wanted.position), 1e-12);
    EXPECT_LT(length(axisX(got.orientation) - axisX(wanted.orientation)), 1e-12);
  }
}

// The quaternions q and -q are the same orientation.
TEST(SensorPath, TakesTheShorterTurn) {
  Pose end = poseAt(Vec3::Zero(), 0.2);
  Quat& q = end.orientation;
  q = {-q.w, -q.x, -q.y, -q.z};
  const SensorPath path(poseAt(Vec3::Zero(), 0.0), end, 1.0);
  EXPECT_NEAR(arcTangent(axisX(path.at(0.5).orientation).y(), axisX(path.at(0.5).orientation).x()),
              0.1, 1e-12);
}

TEST(SensorPath, PlacesAreGivenInTheFrameAtTheBeginning) {
  const SensorPath path(poseAt(Vec3(1, 0, 0), 0.0), poseAt(Vec3(3, 0, 0), PI / 2), 0.1);
  EXPECT_LT(length(path.toBegin(0.0, Vec3(5, 1, 2)) - Vec3(5, 1, 2)), 1e-12);
  EXPECT_LT(length(path.toBegin(0.1, Vec3(5, 1, 2)) - Vec3(1, 5, 2)), 1e-12);
}

}  // namespace
}  // namespace vegetation_sim::scan
