// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/warp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/canopy/plane_scene.h"

namespace vegetation_sim::canopy {
namespace {

// S3-24: the root stands; with r = 0 all moves alike.
TEST(Mobility, IsNothingAtTheRootAndAllAtTheTop) {
  for (const double r : {0.5, 1.0, 1.5, 2.7, 10.0}) {
    EXPECT_EQ(mobility(0.0, 2.0, r), 0.0) << r;
    EXPECT_EQ(mobility(2.0, 2.0, r), 1.0) << r;
    EXPECT_NEAR(mobility(0.7, 2.0, r), std::pow(0.35, r), 1e-8) << r;
    EXPECT_EQ(mobility(-1.0, 2.0, r), 0.0) << r;
    EXPECT_EQ(mobility(3.0, 2.0, r), 1.0) << r;
  }
  EXPECT_EQ(mobility(0.0, 2.0, 0.0), 1.0);
  EXPECT_EQ(mobility(1.0, 0.0, 1.0), 0.0);
}

// S3-24, E10: right 1, 0.875, 0.5; printed 0.5, 0.375, 0.
TEST(DepthShare, FallsToWhatTheTextSays) {
  WarpSettings settings;
  settings.depth_loss = 0.5;
  EXPECT_EQ(depthShare(settings, 0.0, 4.0), 1.0);
  EXPECT_EQ(depthShare(settings, 2.0, 4.0), 0.875);
  EXPECT_EQ(depthShare(settings, 4.0, 4.0), 0.5);
  EXPECT_EQ(depthShare(settings, 0.0, 0.0), 1.0);  // one layer
  settings.form = Formula::PRINTED;
  EXPECT_EQ(depthShare(settings, 0.0, 4.0), 0.5);
  EXPECT_EQ(depthShare(settings, 4.0, 4.0), 0.0);
  settings.depth_loss = 0.0;
  EXPECT_EQ(depthShare(settings, 0.0, 4.0), 0.0);  // nothing moves at all
}

// E10: the same at 15, 30 and 60 Hz; the printed one halves with the step.
TEST(Displacement, DoesNotDependOnTheStep) {
  WarpSettings settings;
  const Vec3 velocity(2.0, 1.0, -1.0);
  const Vec3 at15 = displacement(settings, velocity, 1.0, 1.0 / 15.0);
  EXPECT_EQ(displacement(settings, velocity, 1.0, 1.0 / 30.0), at15);
  EXPECT_EQ(displacement(settings, velocity, 1.0, 1.0 / 60.0), at15);
  settings.form = Formula::PRINTED;
  EXPECT_NEAR(displacement(settings, velocity, 1.0, 1.0 / 30.0).x(),
              0.5 * displacement(settings, velocity, 1.0, 1.0 / 15.0).x(), 1e-12);
}

// S3-25: what moves in depth looks shorter, either way.
TEST(Displacement, ShrinksWithMotionInDepth) {
  const WarpSettings settings;
  double last = 1.0;
  for (const double vz : {0.0, 0.5, 1.0, 4.0}) {
    const double height = displacement(settings, Vec3(1.0, 0.0, vz), 1.0, 0.1).y();
    EXPECT_LT(height, last);
    EXPECT_EQ(height, displacement(settings, Vec3(1.0, 0.0, -vz), 1.0, 0.1).y());
    last = height;
  }
}

// S3-27: nothing moves, nothing is displaced. S3-26: a scale for each axis.
TEST(Displacement, IsTheIdentityAtRestAndScalesByAxis) {
  WarpSettings settings;
  EXPECT_EQ(displacement(settings, Vec3::Zero(), 1.0, 0.1), Vec3(0.0, 0.0, 0.0));
  settings.lambda = Vec3(2.0, 0.5, 0.0);
  settings.reference_time = 0.1;
  EXPECT_NEAR(displacement(settings, Vec3(1.0, 1.0, 9.0), 0.5, 0.1).x(), 0.1, 1e-15);
  EXPECT_NEAR(displacement(settings, Vec3(1.0, 1.0, 9.0), 0.5, 0.1).y(), 0.025, 1e-15);
}

// S3-W4: another method than the grid warp, which stretches: a bend keeps each point's distance.
TEST(Bent, KeepsTheDistanceFromTheFoot) {
  const Vec3 arm(0.2, -0.1, 1.5), push(0.6, 0.3, -0.1);
  const Vec3 way = bent(arm, push);
  EXPECT_NEAR(length(Vec3(arm + way)), length(arm), 1e-12);
  EXPECT_GT(dot(way, push), 0.0);
  EXPECT_GT(length(Vec3(arm + push)), length(arm) + 0.05);  // what the grid warp does
  EXPECT_EQ(bent(arm, Vec3::Zero()), Vec3(0.0, 0.0, 0.0));
}

// S3-W3: a push on the face of a leaf turns it about its midrib, one along the face does not.
TEST(Twisted, TurnsALeafThatIsPushedOnItsFace) {
  WarpSettings settings;
  const Vec3 along(0.0, 0.0, 0.1), side(0.02, 0.0, 0.0);
  const Vec3 pushed = twisted(settings, along, side, Vec3(0.0, 0.2, 0.0));
  EXPECT_NEAR(length(pushed), 0.02, 1e-12);
  EXPECT_NEAR(dot(pushed, along), 0.0, 1e-12);
  const double turn = std::acos(dot(pushed, side) / 0.0004);
  EXPECT_NEAR(turn, std::atan(0.6), 1e-9);  // 0.3 of twice its length
  EXPECT_EQ(twisted(settings, along, side, Vec3(0.2, 0.0, 0.0)), side);
  EXPECT_LT(std::acos(dot(twisted(settings, along, side, Vec3(0.0, 90.0, 0.0)), side) / 0.0004),
            1.571);
  settings.twist = 0.0;  // as the paper has it
  EXPECT_EQ(twisted(settings, along, side, Vec3(0.0, 0.2, 0.0)), side);
}

/// Smallest determinant of the gradient of x + reach * motion over the corners of all cells.
double smallestDeterminant(const LayerMotion& motion, double reach, double cell) {
  const int size = motion.plane.size;
  const auto at = [&](const std::vector<double>& values, int x, int y) {
    return reach / cell * values[static_cast<std::size_t>((y % size) * size + x % size)];
  };
  double out = 1.0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const int right : {0, 1})
        for (const int above : {0, 1}) {
          const auto dx = [&](const std::vector<double>& v) {
            return at(v, x + 1, y + above) - at(v, x, y + above);
          };
          const auto dy = [&](const std::vector<double>& v) {
            return at(v, x + right, y + 1) - at(v, x + right, y);
          };
          const std::vector<double>&u = motion.plane.u, &v = motion.plane.v;
          out = std::min(out, (1.0 + dx(u)) * (1.0 + dy(v)) - dy(u) * dx(v));
        }
  return out;
}

// Numerics, section 2.8: leaves of a layer never change places, in 1 000 storms.
TEST(LimitFolding, LeavesAMapThatCanBeInverted) {
  double folded = 1.0, kept = 1.0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    LayerMotion motion{smoothFlow(16, seed), {}};
    for (double& value : motion.plane.u) value = 3.0 * value + 5.0;
    const double reach = 0.1, cell = 0.0625;
    folded = std::min(folded, smallestDeterminant(motion, reach, cell));
    EXPECT_LT(limitFolding(motion, reach, cell), 1.0);
    kept = std::min(kept, smallestDeterminant(motion, reach, cell));
    double mean = 0.0;
    for (const double value : motion.plane.u) mean += value / 256.0;
    ASSERT_NEAR(mean, 5.0, 1e-9);  // the mean motion stays
  }
  EXPECT_LT(folded, 0.0);
  EXPECT_GT(kept, 0.0);
  LayerMotion gentle{smoothFlow(64, 1), {}};
  EXPECT_EQ(limitFolding(gentle, 0.01, 0.1), 1.0);
}

}  // namespace
}  // namespace vegetation_sim::canopy
