// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/rod.h"

#include <gtest/gtest.h>

#include "reference/sensors/capsule.h"
#include "scenes/sensors/lidar_scene.h"

namespace vegetation_sim::scan {
namespace {

// Signed distance of a point from the bar, its side taken as perpendicular to the axis: at most
// slope^2 / 2 of the radius too large.
double outside(const Vec3& place, const Rod& rod) {
  const double along = dot(place - rod.base, rod.axis);
  const double at = std::clamp(along, 0.0, rod.length);
  const double radius = rod.base_radius + (rod.tip_radius - rod.base_radius) * at / rod.length;
  return length(place - rod.base - at * rod.axis) - radius;
}

Rod randomRod(const Random& random, std::uint64_t i) {
  const Vec3 base(random.uniform(9 * i, -1.0, 1.0), random.uniform(9 * i + 1, -1.0, 1.0), 0.0);
  // As slender as wood is: slope^2 of the radius is then less than 0.1 mm.
  const double size = random.uniform(9 * i + 2, 0.1, 2.0);
  const double radius = size * random.uniform(9 * i + 3, 0.005, 0.05);
  return rodBetween(base, base + size * randomDirection(random, i + 1000, -1.5, 1.5), radius,
                    radius * random.uniform(9 * i + 4, 0.3, 1.0));
}

// N1
TEST(Rod, IsMetOnItsSideAndItsEnds) {
  const Rod rod = rodBetween(Vec3(0, 0, 0), Vec3(0, 0, 2), 0.2, 0.1);
  Meeting side, end;
  ASSERT_TRUE(meet(Ray(Vec3(-3, 0, 1), Vec3(1, 0, 0)), rod, 10.0, side));
  EXPECT_NEAR(side.distance, 3.0 - 0.15, 1e-12);
  EXPECT_NEAR(side.cosine, 1.0 / std::sqrt(1.0 + 0.05 * 0.05), 1e-12);
  ASSERT_TRUE(meet(Ray(Vec3(0, 0, 5), Vec3(0, 0, -1)), rod, 10.0, end));
  EXPECT_NEAR(end.distance, 2.9, 1e-12);
  ASSERT_TRUE(meet(Ray(Vec3(0.15, 0, 5), Vec3(0, 0, -1)), rod, 10.0, side));  // past the tip
  EXPECT_NEAR(side.distance, 4.0, 1e-12);
  EXPECT_NEAR(side.cosine, 0.05 / std::sqrt(1.0 + 0.05 * 0.05), 1e-12);
  const Vec3 steep = Vec3(-0.02, 0, -1).normalized();  // steeper than the side, which it meets
  ASSERT_TRUE(meet(Ray(Vec3(0.15, 0, 1) - 4.0 * steep, steep), rod, 10.0, side));
  EXPECT_NEAR(side.distance, 4.0, 1e-12);
  EXPECT_FALSE(meet(Ray(Vec3(-3, 0, 1), Vec3(1, 0, 0)), rod, 2.0, side));
  EXPECT_FALSE(meet(Ray(Vec3(-3, 0, 1), Vec3(-1, 0, 0)), rod, 10.0, side));
  EXPECT_FALSE(meet(Ray(Vec3(0, 0, 1), Vec3(1, 0, 0)), rod, 10.0, side));  // from inside
}

// N1. Marched along in steps of the distance to the surface.
TEST(Rod, IsMetWhereAMarchAlongTheRayMeetsIt) {
  const Random random(3);
  int met = 0, grazing = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Rod rod = randomRod(random, i);
    const Vec3 from = 4.0 * randomDirection(random, i + 9000, -1.5, 1.5);
    const Vec3 aim = rod.base + random.uniform(9 * i + 5) * rod.length * rod.axis +
                     0.05 * randomDirection(random, i + 20000, -1.5, 1.5);
    const Ray ray(from, (aim - from).normalized());
    double marched = 0.0;
    for (int k = 0; k < 4000 && marched < 8.0 && outside(ray.at(marched), rod) > 1e-9; ++k)
      marched += 0.5 * outside(ray.at(marched), rod);
    Meeting meeting;
    const bool meets = meet(ray, rod, 8.0, meeting);
    met += meets ? 1 : 0;
    if (meets != (marched < 8.0)) {
      ++grazing;
      continue;
    }
    if (!meets) continue;
    EXPECT_NEAR(outside(ray.at(meeting.distance), rod), 0.0, 2e-4) << i;
    EXPECT_NEAR(meeting.distance, marched, 0.05) << i;
  }
  EXPECT_LT(grazing, 8);  // the march stops short of the very edge
  EXPECT_GT(met, 1000);
}

TEST(Rod, StretchWithinARadiusHasItsEndsThere) {
  const Random random(4);
  int crossed = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Rod rod = randomRod(random, i);
    rod.base_radius = rod.tip_radius = 0.3;
    const Vec3 from = 4.0 * randomDirection(random, i + 9000, -1.5, 1.5);
    const Ray ray(from, (Vec3::Zero() - from).normalized());
    const Stretch part = within(ray, rod, 0.3);
    if (!(part.from < part.to)) continue;
    ++crossed;
    EXPECT_NEAR(outside(ray.at(part.from), rod), 0.0, 1e-9);
    EXPECT_NEAR(outside(ray.at(part.to), rod), 0.0, 1e-9);
    EXPECT_LT(outside(ray.at(0.5 * (part.from + part.to)), rod), 0.0);
  }
  EXPECT_GT(crossed, 100);
}

// Balls at the ends are left out only where they cannot change a bit.
TEST(Rod, StretchHasTheBitsOfThePlainOne) {
  const Random random(11);
  int crossed = 0, different = 0;
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const Rod rod = randomRod(random, i % 500);
    const double radius = random.uniform(4 * i, 0.001, 0.5);
    // Many rays aim at the planes where the balls begin.
    const double along =
        i % 3 == 0 ? random.uniform(4 * i + 1, 0.0, rod.length)
                   : (i % 3 == 1 ? 0.0 : rod.length) + random.uniform(4 * i + 1, -2e-3, 2e-3);
    const Vec3 aim =
        rod.base + along * rod.axis + radius * randomDirection(random, 3 * i + 9000, -1.5, 1.5);
    const Vec3 from = 40.0 * randomDirection(random, 3 * i + 9001, -1.5, 1.5);
    const Ray ray(from, i % 7 == 0 ? rod.axis : Vec3((aim - from).normalized()));
    const Stretch fast = within(ray, rod, radius), plain = withinPlainly(ray, rod, radius);
    different += fast.from != plain.from || fast.to != plain.to;
    crossed += plain.from < plain.to;
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(crossed, 50'000);
}

}  // namespace
}  // namespace vegetation_sim::scan
