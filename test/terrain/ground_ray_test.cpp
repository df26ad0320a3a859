// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/ground_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "vegetation_sim/core/math/random.h"

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

// Hills of several blocks in both directions.
HeightMap hills() {
  const Random random(3);
  GreyImage image{90, 50, 255, {}};
  for (int i = 0; i < image.columns * image.rows; ++i) {
    const double u = 0.11 * (i % image.columns), v = 0.13 * (i / image.columns);
    const double noise = random.uniform(static_cast<std::uint64_t>(i), 0.0, 20.0);
    image.samples.push_back(
        static_cast<std::uint16_t>(100.0 + 60.0 * std::sin(u) + 60.0 * std::sin(v) + noise));
  }
  HeightMapLaw law;
  law.height_max = 12.0;
  law.origin = Vec3(-20.0, 5.0, -3.0);
  return HeightMap(law, image);
}

TEST(GroundRay, MeetsWhatARayMeetsThatIsLookedAtEveryStep) {
  const HeightMap ground = hills();
  const Random random(4);
  int met = 0, missed = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    Vec3 origin(random.uniform(10 * i, -60.0, 110.0), random.uniform(10 * i + 1, -40.0, 90.0), 0.0);
    origin.z() = ground.height(origin.x(), origin.y()) + random.uniform(10 * i + 2, 0.1, 8.0);
    const Vec3 along =
        Vec3(random.uniform(10 * i + 3, -1.0, 1.0), random.uniform(10 * i + 4, -1.0, 1.0),
             random.uniform(10 * i + 5, -0.3, 0.1))
            .normalized();
    const double reach = 60.0;
    double met_at = -1.0;
    for (double s = 0.0; s < reach && met_at < 0.0; s += 0.01) {
      const Vec3 point = origin + s * along;
      if (point.z() <= ground.height(point.x(), point.y())) met_at = s;
    }
    Vec3 place;
    const bool meets = meetGround(ground, origin, along, reach, place);
    // A ridge narrower than a step may be missed.
    if (meets && met_at >= 0.0 && std::fabs((place - origin).norm() - met_at) < 0.02)
      ++met;
    else if (meets == (met_at >= 0.0) && !meets)
      ++missed;
  }
  EXPECT_GE(met + missed, 3960);
  EXPECT_GE(met, 1000);
  EXPECT_GE(missed, 1000);
}

// A ray that is level with a terrace meets it at its edge, where the ground has its height exactly.
TEST(GroundRay, MeetsATerraceOfItsOwnHeight) {
  GreyImage image{4, 2, 8, {0, 0, 8, 8, 0, 0, 8, 8}};
  HeightMapLaw law;
  law.resolution = 100.0;
  law.height_max = 8.0;
  const HeightMap ground(law, image);
  for (int i = 0; i < 200; ++i) {
    const Vec3 origin(0.37 * i, 50.0, 8.0);
    Vec3 place;
    ASSERT_TRUE(meetGround(ground, origin, {1.0, 0.0, 0.0}, FARTHEST, place)) << i;
    ASSERT_NEAR(place.x(), 200.0, 2e-3) << i;
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
