// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/contact/rounded_box.h"

#include <gtest/gtest.h>

#include <vector>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::physics {
namespace {

const RoundedBox SPHERE{Vec3::Zero(), 0.1};
const RoundedBox CAPSULE{Vec3(0, 0, 0.4), 0.05};
const RoundedBox BOX{Vec3(0.3, 0.2, 0.1), 0.0};

// The curvature that centres flat contacts tilts a normal by up to 2 * 2e-3 / m times half the
// length.
constexpr double BOWL_TILT = 2e-3;

Vec3 randomVector(const Random& random, std::uint64_t index, double size) {
  const auto at = [&](std::uint64_t i) {
    return size * (2.0 * random.uniform(3 * index + i) - 1.0);
  };
  return {at(0), at(1), at(2)};
}

Bar randomBar(const Random& random, std::uint64_t index) {
  const Vec3 span = randomVector(random, 2 * index + 1, 0.7);
  return {randomVector(random, 2 * index, 0.8), span / length(span), length(span), 0.02, 0.01};
}

// The simple way: tries many points.
double sampledGap(const RoundedBox& box, const Bar& bar) {
  double out = 1e9;
  Vec3 normal;
  for (int i = 0; i <= 4000; ++i) {
    const double along = bar.length * i / 4000.0;
    out = std::min(out, signedDistance(box, bar.at(along), normal) - bar.radiusAt(along));
  }
  return out;
}

TEST(RoundedBox, NormalHasUnitLengthHoweverNearTheCentreIs) {
  for (const double way : {0.0, 5e-324, 1.8e-307, 1e-160, 1e-150, 1e-140, 1e-9}) {
    Vec3 normal;
    EXPECT_NEAR(signedDistance(SPHERE, Vec3(way, -way, 0.0), normal), -0.1, 1e-8) << way;
    EXPECT_NEAR(length(normal), 1.0, 1e-15) << way;
  }
}

TEST(RoundedBox, DistancesToSimpleShapes) {
  Vec3 normal;
  EXPECT_NEAR(signedDistance(SPHERE, Vec3(0, 0.3, 0), normal), 0.2, 1e-15);
  EXPECT_NEAR(length(normal - Vec3::UnitY()), 0.0, 1e-15);
  EXPECT_NEAR(signedDistance(CAPSULE, Vec3(0, 0.25, 0.3), normal), 0.2, 1e-15);
  EXPECT_NEAR(signedDistance(CAPSULE, Vec3(0.3, 0, 0.8), normal), 0.45, 1e-15);
  EXPECT_NEAR(signedDistance(BOX, Vec3(0.05, 0, -0.09), normal), -0.01, 1e-15);
  EXPECT_NEAR(length(normal + Vec3::UnitZ()), 0.0, 1e-15);
}

TEST(RoundedBox, NearestPointsAreThoseOfADenseSearch) {
  const Random random(7);
  for (const RoundedBox& box : {SPHERE, CAPSULE, BOX}) {
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Bar bar = randomBar(random, i);
      // The curvature and the samples' spacing each cost less than a tenth of a millimetre.
      EXPECT_NEAR(nearest(box, bar).gap, sampledGap(box, bar), 5e-4);
    }
  }
}

TEST(RoundedBox, BarThatLiesFlatIsTouchedInItsMiddle) {
  const Bar bar{Vec3(-0.1, 0.0, 0.12), Vec3::UnitX(), 0.2, 0.01, 0.01};
  const Proximity found = nearest(BOX, bar);
  EXPECT_NEAR(found.along, 0.1, 1e-3);
  EXPECT_NEAR(found.gap, 0.01, 1e-9);
}

//   | bar driven through a capsule (o) along x: its depth keeps growing, its side stays
//  o|  ->
TEST(RoundedBox, SideIsKeptThroughTheAxis) {
  const Vec3 side = -Vec3::UnitX();
  for (int i = 0; i <= 100; ++i) {
    const double x = -0.08 + 0.0015 * i;  // from outside, through the axis, to the far surface
    const Bar bar{Vec3(x, -0.2, 0.0), Vec3::UnitY(), 0.5, 0.01, 0.01};
    const Proximity found = nearest(CAPSULE, bar, side);
    EXPECT_NEAR(found.gap, -x - 0.06, 1e-6) << x;
    EXPECT_NEAR(length(found.normal - side), 0.0, BOWL_TILT) << x;
  }
}

TEST(RoundedBox, SideMayChangeWhereNothingOverlaps) {
  const Bar bar{Vec3(0.0, 0.08, -0.2), Vec3::UnitX(), 0.5, 0.01, 0.01};
  const Proximity found = nearest(CAPSULE, bar, Vec3(-0.8, 0.6, 0.0));
  EXPECT_NEAR(length(found.normal - Vec3::UnitY()), 0.0, BOWL_TILT);
}

// A thin bar crosses the whole body between two instants and is met nevertheless.
TEST(RoundedBox, SweepMissesNoFastBar) {
  const Bar bar{Vec3(-1.0, -0.3, 0.1), Vec3::UnitY(), 0.6, 0.002, 0.002};
  const Meeting meeting = sweep(CAPSULE, bar, Vec3(300, 0, 0), Vec3(300, 0, 0), 0.01);
  ASSERT_TRUE(meeting.met);
  EXPECT_NEAR(meeting.time, (1.0 - 0.052) / 300.0, 1e-6);
  EXPECT_NEAR(length(meeting.there.normal + Vec3::UnitX()), 0.0, 1e-3);
}

TEST(RoundedBox, SweepExcludesWhatPassesBeside) {
  const Bar bar{Vec3(-1.0, 0.06, 0.1), Vec3::UnitY(), 0.6, 0.002, 0.002};
  EXPECT_FALSE(sweep(CAPSULE, bar, Vec3(300, 0, 0), Vec3(300, 0, 0), 0.01).met);
  EXPECT_FALSE(sweep(CAPSULE, bar, Vec3::Zero(), Vec3::Zero(), 0.01).met);
}

}  // namespace
}  // namespace vegetation_sim::physics
