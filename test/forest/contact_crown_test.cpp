// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A capsule of 5 cm driven through crowns that are physical as a whole.
#include <gtest/gtest.h>

#include "forest/crown_scene.h"

namespace vegetation_sim::forest {
namespace {

/// A drive along x, level, that meets thin wood.
struct Way {
  const char* species;
  double x, y, z;  // where it starts [m]
  double length;   // [m]
};

CrownResult driveAt(double speed, double radius, const Way& way, double* left_over = nullptr) {
  CrownScene scene(way.species, 7);
  const CrownResult out = scene.drive(Vec3(way.x, way.y, way.z), radius, 0.6, speed, way.length);
  if (left_over) *left_over = scene.leftOver(30.0);
  return out;
}

constexpr Way BIRCH{"birch", -1.5, 0.3, 6.5, 1.2};
constexpr Way OAK{"oak", -2.0, 0.0, 7.45, 1.5};

// S1-W6. At every speed of a robot, thin wood goes aside: no deeper than 5 mm at any instant.
TEST(ContactInACrown, ThinWoodGoesAsideAtAnySpeed) {
  for (const double speed : {0.1, 0.5, 1.0, 2.0, 3.0}) {
    const CrownResult found = driveAt(speed, 0.025, BIRCH);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_GE(found.touched, 5) << speed << " m/s";
    EXPECT_EQ(found.disagreed, 0) << speed << " m/s";
    // No force rises faster than the law says.
    EXPECT_LE(found.largest_rise, 1e5 / PHYSICS_RATE + 1e-6) << speed << " m/s";
  }
}

// Wood that cannot give way answers with the limit, while the thin wood around it still goes aside.
TEST(ContactInACrown, ThickWoodAnswersWithTheLimit) {
  for (const double speed : {0.5, 3.0}) {
    const CrownResult found = driveAt(speed, 0.025, OAK);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_EQ(found.hardest, physics::ContactLaw().force_limit) << speed << " m/s";
    EXPECT_GT(found.deepest_thick, 0.005) << speed << " m/s";
    EXPECT_GT(found.limited, 0) << speed << " m/s";
  }
}

TEST(ContactInACrown, EverythingReturns) {
  double left_over = 1.0;
  const CrownResult found = driveAt(2.0, 0.025, BIRCH, &left_over);
  EXPECT_GT(found.touched, 5);
  EXPECT_LT(left_over, 2e-3);  // what still swings after half a minute
}

}  // namespace
}  // namespace vegetation_sim::forest
