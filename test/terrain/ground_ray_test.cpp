// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/ground_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace vegetation_sim::terrain {
namespace {

constexpr double FARTHEST = 1000.0;  // [m]

// Waves of 4 m from trough to crest along x, 1 m between samples.
HeightMap waves() {
  GreyImage image{64, 64, 255, {}};
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
      image.samples.push_back(
          static_cast<std::uint16_t>(std::lround(127.5 + 127.5 * std::sin(0.3 * column))));
  HeightMapLaw law;
  law.height_max = 4.0;
  return HeightMap(law, image);
}

TEST(GroundRay, MeetsFlatGroundWhereItMust) {
  Vec3 place;
  ASSERT_TRUE(meetGround({}, {1.0, 2.0, 10.0}, {3.0, 0.0, -5.0}, FARTHEST, place));
  EXPECT_LT((place - Vec3(7.0, 2.0, 0.0)).norm(), 2e-3);
}

TEST(GroundRay, MeetsTheFirstCrestOnItsWay) {
  const HeightMap ground = waves();
  const Vec3 origin(0.5, 30.0, 5.0), along = Vec3(1.0, 0.1, -0.12).normalized();
  Vec3 place;
  ASSERT_TRUE(meetGround(ground, origin, along, FARTHEST, place));
  EXPECT_NEAR(place.z(), ground.height(place.x(), place.y()), 2e-3);
  const double distance = (place - origin).norm();
  for (double s = 0.0; s < distance - 0.01; s += 0.01) {
    const Vec3 point = origin + s * along;
    ASSERT_GT(point.z(), ground.height(point.x(), point.y())) << s;
  }
}

TEST(GroundRay, MissesFromBelowUpwardsAndBeyondItsReach) {
  const HeightMap ground = waves();
  Vec3 place;
  EXPECT_FALSE(meetGround(ground, {5.0, 5.0, -1.0}, {0.0, 0.0, 1.0}, FARTHEST, place));
  EXPECT_FALSE(meetGround(ground, {5.0, 5.0, 9.0}, {1.0, 0.0, 0.1}, FARTHEST, place));
  EXPECT_FALSE(meetGround(ground, {5.0, 5.0, 90.0}, {0.0, 0.0, -1.0}, 50.0, place));
  EXPECT_TRUE(meetGround(ground, {5.0, 5.0, 90.0}, {0.0, 0.0, -1.0}, 100.0, place));
}

TEST(GroundRay, MissesWithoutADirectionOrWithOneThatIsNoNumber) {
  Vec3 place;
  EXPECT_FALSE(meetGround({}, {0.0, 0.0, 1.0}, Vec3::Zero(), FARTHEST, place));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(meetGround({}, {0.0, 0.0, nan}, {0.0, 0.0, -1.0}, FARTHEST, place));
}

}  // namespace
}  // namespace vegetation_sim::terrain
