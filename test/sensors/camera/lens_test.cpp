// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace vegetation_sim::scan {
namespace {

LensSettings wideAngle() {
  LensSettings out;
  out.field_of_view = 1.5;
  out.distortion = {-0.28, 0.07, 0.0012, -0.0008, -0.006};
  return out;
}

// The formula of OpenCV's projectPoints(), written down plainly.
Pixel projectPlainly(const Lens& lens, const Vec3& place) {
  const double x = place.x() / place.z(), y = place.y() / place.z();
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const Distortion& d = lens.distortion;
  const double xx =
      x * (1 + d.k1 * r2 + d.k2 * r4 + d.k3 * r6) + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x);
  const double yy =
      y * (1 + d.k1 * r2 + d.k2 * r4 + d.k3 * r6) + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y;
  return {lens.fx * xx + lens.cx, lens.fy * yy + lens.cy};
}

double roundTripError(const Lens& lens) {
  double most = 0.0;
  for (double u = -0.5; u < lens.width; u += 0.07 * lens.width)
    for (double v = -0.5; v < lens.height; v += 0.07 * lens.height) {
      const Vec3 direction = directionOf(lens, {u, v});
      EXPECT_NEAR(length(direction), 1.0, 1e-15);
      const Pixel back = projectPlainly(lens, 3.7 * direction);
      most = std::max(most, std::hypot(back.u - u, back.v - v));
    }
  return most;
}

std::string faultsOf(const Lens& lens) {
  Faults faults;
  check(lens, "camera/", faults);
  return faults.text();
}

TEST(Lens, ARayThroughAPixelComesBackToIt) {
  Lens pincushion = lensOf(wideAngle());
  pincushion.distortion = {0.2, 0.05, -0.002, 0.001, 0.01};
  Lens skewed = lensOf(wideAngle());
  skewed.fy = 1.3 * skewed.fx;
  skewed.cx += 20.0;
  skewed.cy -= 15.0;
  for (const Lens& lens : {lensOf(LensSettings()), lensOf(wideAngle()), pincushion, skewed}) {
    EXPECT_EQ(faultsOf(lens), "");
    const double error = roundTripError(lens);
    EXPECT_LT(error, LENS_ERROR);
    RecordProperty("error_pixels", std::to_string(error));
  }
}

TEST(Lens, ProjectsAsOpenCvDoes) {
  const Lens lens = lensOf(wideAngle());
  for (const Vec3& place : {Vec3(0.3, -0.2, 1.0), Vec3(-2.0, 1.5, 3.0), Vec3(0.0, 0.0, 5.0)}) {
    const Pixel ours = project(lens, place), plain = projectPlainly(lens, place);
    EXPECT_NEAR(ours.u, plain.u, 1e-10);
    EXPECT_NEAR(ours.v, plain.v, 1e-10);
  }
}

// The outer edges of the first and the last pixel are half of the field of view from the axis.
TEST(Lens, TheFieldOfViewReachesFromEdgeToEdge) {
  LensSettings settings;
  settings.field_of_view = 1.3;
  const Lens lens = lensOf(settings);
  for (const double sign : {-1.0, 1.0}) {
    const Vec3 edge = directionOf(lens, {159.5 + 160.0 * sign, 119.5});
    EXPECT_NEAR(std::atan2(edge.x(), edge.z()), 0.65 * sign, 1e-12);
    EXPECT_NEAR(edge.y(), 0.0, 1e-12);
  }
}

TEST(Lens, ADistortionThatFoldsTheImageIsRejected) {
  Lens lens = lensOf(wideAngle());
  lens.distortion = {-0.5, 0.0, 0.0, 0.0, 0.0};  // r - r^3/2 falls beyond r = 0.82
  EXPECT_NE(faultsOf(lens).find("camera/the distortion k1 to k3 has no inverse at pixel (-0.5"),
            std::string::npos);
  LensSettings narrow = wideAngle();
  narrow.field_of_view = 0.6;
  narrow.distortion = lens.distortion;
  EXPECT_EQ(faultsOf(lensOf(narrow)), "");
}

TEST(Lens, ValuesOutOfRangeAreNamed) {
  Lens lens = lensOf(LensSettings());
  lens.width = 4097;
  lens.fx = 0.0;
  lens.cy = std::nan("");
  lens.distortion.k2 = 11.0;
  const std::string faults = faultsOf(lens);
  for (const char* text : {"width = 4097 pixel is outside 1 to 4096", "fx = 0", "cy = nan",
                           "k2 = 11 is outside -10 to 10"})
    EXPECT_NE(faults.find(text), std::string::npos) << faults;
}

}  // namespace
}  // namespace vegetation_sim::scan
