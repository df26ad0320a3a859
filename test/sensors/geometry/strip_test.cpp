// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/strip.h"

#include <gtest/gtest.h>

#include "sensors/traversal/strip_tree.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::scan {
namespace {

/// A trapezium in the plane z = 2: 2 m wide at the root, 1 m at the tip, 4 m long.
Strip trapezium() {
  return {Vec3(0, 0, 2), Vec3(4, 0, 2), Vec3(0, 1, 0), Vec3(0, 0.5, 0)};
}

Vec3 randomVector(const Random& random, std::uint64_t i, double size) {
  return size * Vec3(random.uniform(3 * i, -1.0, 1.0), random.uniform(3 * i + 1, -1.0, 1.0),
                     random.uniform(3 * i + 2, -1.0, 1.0));
}

std::vector<Strip> randomStrips(std::uint64_t count) {
  const Random random(8);
  std::vector<Strip> out;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3 root = Vec3(40, -30, 2) + randomVector(random, 4 * i, 3.0);
    out.push_back({root, root + randomVector(random, 4 * i + 1, 0.3),
                   randomVector(random, 4 * i + 2, 0.08), randomVector(random, 4 * i + 3, 0.03)});
  }
  return out;
}

// The half width at x is 1 - x / 8.
TEST(Strip, IsMetExactlyWithinItsCorners) {
  const Random random(2);
  int inside = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double x = random.uniform(2 * i, -1.0, 5.0), y = random.uniform(2 * i + 1, -1.5, 1.5);
    Meeting meeting;
    const bool met = meet(Ray(Vec3(x, y, 0), Vec3(0, 0, 1)), trapezium(), 10.0, meeting);
    const bool wanted = x > 0.0 && x < 4.0 && std::fabs(y) < 1.0 - x / 8.0;
    ASSERT_EQ(met, wanted) << x << " " << y;
    if (!met) continue;
    ++inside;
    EXPECT_NEAR(meeting.distance, 2.0, 1e-12);
    EXPECT_NEAR(meeting.cosine, 1.0, 1e-12);
  }
  EXPECT_NEAR(inside / 4000.0, 6.0 / 18.0, 0.03);
}

TEST(Strip, IsMetFromBothSidesWithTheCosineOfIncidence) {
  const Vec3 way = Vec3(0.6, 0.0, -0.8);
  Meeting meeting;
  ASSERT_TRUE(meet(Ray(Vec3(1, 0, 2) - 5.0 * way, way), trapezium(), 10.0, meeting));
  EXPECT_NEAR(meeting.distance, 5.0, 1e-12);
  EXPECT_NEAR(meeting.cosine, 0.8, 1e-12);
  EXPECT_FALSE(meet(Ray(Vec3(1, 0, 2) - 5.0 * way, way), trapezium(), 4.9, meeting));
  EXPECT_FALSE(meet(Ray(Vec3(1, 0, 2) + 5.0 * way, way), trapezium(), 10.0, meeting));
  EXPECT_FALSE(meet(Ray(Vec3(-3, 0, 2), Vec3(1, 0, 0)), trapezium(), 10.0, meeting));
}

// The tree must find what a test of every strip finds, to the bit, also after the strips moved.
TEST(StripTree, VisitsEveryStripThatARayHits) {
  std::vector<Strip> strips = randomStrips(800);
  const Vec3 origin(40, -30, 2);
  StripTree tree;
  tree.build(strips, origin);
  const Random random(4);
  int hits = 0;
  for (int round = 0; round < 2; ++round) {
    for (std::uint64_t i = 0; i < 1500; ++i) {
      const Vec3 from = origin + 8.0 * randomVector(random, 2 * i, 1.0).normalized();
      const Vec3 to = origin + randomVector(random, 2 * i + 1, 3.0);
      const Ray ray(from, (to - from).normalized());
      Hit found, plain;
      found.distance = plain.distance = 30.0;
      Meeting meeting;
      const auto test = [&](std::size_t strip, Hit& hit) {
        if (meet(ray, strips[strip], hit.distance, meeting))
          hit = {meeting.distance, Label::FOLIAGE, 0, static_cast<int>(strip), meeting.cosine};
      };
      tree.visit(ray, FloatRay(ray), found, [&](std::size_t strip) { test(strip, found); });
      for (std::size_t strip = 0; strip < strips.size(); ++strip) test(strip, plain);
      EXPECT_EQ(found.distance, plain.distance);
      EXPECT_EQ(found.branch, plain.branch);
      hits += plain.label != Label::NONE;
    }
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const Vec3 moved = randomVector(Random(9), i, 0.2);
      strips[i].root += moved;
      strips[i].tip += 2.0 * moved;
    }
    tree.fit(strips, origin);
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace vegetation_sim::scan
