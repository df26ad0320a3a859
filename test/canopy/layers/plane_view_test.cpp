// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/plane_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reference/canopy/printed_view.h"
#include "scenes/canopy/plane_scene.h"

namespace vegetation_sim::canopy {
namespace {

Quat randomTurn(const Random& random, std::uint64_t i) {
  Quat q{random.uniform(4 * i, -1.0, 1.0), random.uniform(4 * i + 1, -1.0, 1.0),
         random.uniform(4 * i + 2, -1.0, 1.0), random.uniform(4 * i + 3, -1.0, 1.0)};
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

// S3-16, S3-17, E8
TEST(PlaneToView, KeepsEveryLengthForAThousandOrientations) {
  const Random random(1);
  double worst_printed = 0.0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Axes plane = axesOf(randomTurn(random, 2 * i)),
               view = axesOf(randomTurn(random, 2 * i + 1));
    const Vec3 v(random.uniform(9000 + 2 * i, -5.0, 5.0), random.uniform(9001 + 2 * i, -5.0, 5.0),
                 0.0);
    EXPECT_NEAR(length(PlaneToView(plane, view).apply(v)), length(v), 1e-12 * length(v));
    const PrintedAngles angles = printedAngles(plane, view);
    const Vec3 printed = printedToView({v.x(), v.y()}, angles.tilt, angles.alpha, angles.beta);
    worst_printed = std::max(worst_printed, std::fabs(length(printed) / length(v) - 1.0));
  }
  EXPECT_GT(worst_printed, 0.5);
}

// S3-15: a picture parallel to the plane shows the motion as it is, and none in depth.
TEST(PlaneToView, IsTheIdentityForAParallelView) {
  const Axes axes = axesOf(randomTurn(Random(2), 7));
  const Vec3 seen = PlaneToView(axes, axes).apply(Vec3(3.0, -4.0, 0.0));
  EXPECT_NEAR(seen.x(), 3.0, 1e-14);
  EXPECT_NEAR(seen.y(), -4.0, 1e-14);
  EXPECT_NEAR(seen.z(), 0.0, 1e-14);
}

// E8, the vector of the errata: at 45 degrees the wind (1, 0, -1) disappears in the printed form.
TEST(PlaneToView, TurnsWhatThePrintedFormLoses) {
  const Axes plane;  // out of it is +x
  Axes view;
  view.right = Vec3(-std::sqrt(0.5), std::sqrt(0.5), 0.0);
  view.out = Vec3(std::sqrt(0.5), std::sqrt(0.5), 0.0);
  const Vec3 seen = PlaneToView(plane, view).apply(Vec3(1.0, 0.0, -1.0));
  EXPECT_NEAR(seen.x(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(seen.z(), 0.0, 1e-12);
  // A plane that lies flat (tilt 0) turns v into depth: (1, 0, -1) in the printed world.
  const Vec3 printed = printedToView({1.0, -1.0}, 0.0, 0.25 * PI, 0.0);
  EXPECT_NEAR(length(printed), 0.0, 1e-12);
}

// S3-16, equation 1: a vertical plane keeps v upright, a flat one lays it down.
TEST(PrintedToView, FollowsEquationOneForItsOwnTilt) {
  const Vec3 upright = printedToView({2.0, 3.0}, 0.5 * PI, 0.0, 0.0);
  EXPECT_NEAR(upright.y(), 3.0, 1e-12);
  EXPECT_NEAR(upright.z(), 0.0, 1e-12);
  const Vec3 flat = printedToView({2.0, 3.0}, 0.0, 0.0, 0.0);
  EXPECT_NEAR(flat.y(), 0.0, 1e-12);
  EXPECT_NEAR(flat.z(), 3.0, 1e-12);
}

// A plane seen edge-on: all that moves across moves in depth.
TEST(PlaneToView, ShowsAnEdgeOnPlaneAsDepth) {
  const Axes plane;
  Axes view;
  view.right = Vec3(-1.0, 0.0, 0.0);
  view.out = Vec3(0.0, 1.0, 0.0);
  const Vec3 seen = PlaneToView(plane, view).apply(Vec3(2.0, 0.0, 0.0));
  EXPECT_NEAR(seen.x(), 0.0, 1e-12);
  EXPECT_NEAR(seen.z(), 2.0, 1e-12);
}

// S3-08
TEST(Plane, IsWhatItsCameraSees) {
  PlaneSettings settings;
  settings.camera = Vec3(1.0, 2.0, 3.0);
  settings.yaw = 0.5 * PI;  // north
  settings.distance = 4.0;
  settings.field_of_view = 0.5 * PI;
  const Plane plane(settings);
  EXPECT_NEAR(plane.width, 8.0, 1e-12);
  EXPECT_LT(length(plane.centre - Vec3(1.0, 6.0, 3.0)), 1e-12);
  EXPECT_LT(length(plane.axes.right - Vec3(1.0, 0.0, 0.0)), 1e-12);
  EXPECT_LT(length(plane.axes.up - Vec3(0.0, 0.0, 1.0)), 1e-12);
  const PlaneVector corner = plane.cellAt(Vec3(-3.0, 6.0, -1.0), 64);  // lower left
  EXPECT_NEAR(corner.u, 0.0, 1e-12);
  EXPECT_NEAR(corner.v, 0.0, 1e-12);
}

// S3-09, S3-10: a tile further the same value; along the normal the same value.
TEST(Plane, RepeatsAcrossAndIsTheSameInDepth) {
  PlaneSettings settings;
  settings.yaw = 0.7;
  settings.pitch = 0.2;
  const Plane plane(settings);
  const PlaneField field = smoothFlow(64, 3);
  const auto at = [&](const Vec3& p) {
    const PlaneVector cell = plane.cellAt(p, 64);
    return bilinear(field, cell.u, cell.v);
  };
  const Vec3 p(0.3, -0.2, 1.1);
  const PlaneVector here = at(p), beside = at(p + 2.0 * plane.width * plane.axes.right),
                    below = at(p - plane.width * plane.axes.up),
                    behind = at(p - 7.3 * plane.axes.out);
  for (const PlaneVector& other : {beside, below, behind}) {
    EXPECT_NEAR(other.u, here.u, 1e-11);
    EXPECT_NEAR(other.v, here.v, 1e-11);
  }
  EXPECT_NE(at(p + 0.4 * plane.axes.right).u, here.u);
}

/// Largest step between neighbours across a seam over the largest elsewhere in the field.
double seamRatio(const PlaneField& field, bool vertical) {
  double seam = 0.0, inside = 0.0;
  const int size = field.size;
  const auto at = [&](int x, int y) {
    return field.u[static_cast<std::size_t>((y % size) * size + x % size)];
  };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const double step = vertical ? at(i, j + 1) - at(i, j) : at(j + 1, i) - at(j, i);
      (j == size - 1 ? seam : inside) = std::max(j == size - 1 ? seam : inside, std::fabs(step));
    }
  return seam / inside;
}

// S3-14: left edge to right edge, bottom to top, corners among them.
TEST(BlendSeams, MakesACutOutFieldTile) {
  const PlaneField wide = smoothFlow(256, 4);
  PlaneField cut(64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      cut.u[static_cast<std::size_t>(y * 64 + x)] = wide.u[static_cast<std::size_t>(y * 256 + x)];
  EXPECT_GT(std::max(seamRatio(cut, true), seamRatio(cut, false)), 3.0);
  blendSeams(cut);
  EXPECT_LE(seamRatio(cut, true), 1.2);
  EXPECT_LE(seamRatio(cut, false), 1.2);
  const PlaneField periodic = smoothFlow(64, 4);  // the default needs no blend
  EXPECT_LE(seamRatio(periodic, true), 1.2);
}

}  // namespace
}  // namespace vegetation_sim::canopy
