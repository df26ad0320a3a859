// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/contact_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

Body capsule() {
  Body out;
  out.id = "arm";
  out.shape = Shape::CAPSULE;
  out.size = Vec3(0.05, 0.0, 0.6);
  out.stamp = 1000000000;
  return out;
}

std::string faultsOf(const Body& body) {
  Faults faults;
  check(body, faults);
  return faults.text();
}

TEST(ContactBody, ShapesAreRoundedBoxes) {
  Body body = capsule();
  EXPECT_EQ(shapeOf(body).half, Vec3(0, 0, 0.3));
  EXPECT_EQ(shapeOf(body).radius, 0.05);
  body.shape = Shape::SPHERE;
  EXPECT_EQ(shapeOf(body).half, Vec3(0, 0, 0));
  body.shape = Shape::BOX;
  body.size = Vec3(0.2, 0.4, 0.6);
  EXPECT_EQ(shapeOf(body).half, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(shapeOf(body).radius, 0.0);
}

// Motion from two samples leads back to the first.
TEST(ContactBody, MotionJoinsTwoPoses) {
  Body body = capsule();
  const Pose before{Vec3(1, 2, 3), {1, 0, 0, 0}};
  const SinCos half = sinCos(0.2);
  body.pose = {Vec3(1.1, 2, 2.8), {half.cos, 0, half.sin, 0}};
  setMotion(body, before, body.pose, 0.1);
  EXPECT_NEAR(length(body.velocity - Vec3(1, 0, -2)), 0.0, 1e-12);
  EXPECT_NEAR(length(body.spin - Vec3(0, 4, 0)), 0.0, 1e-12);
  const Pose then = poseAt(body, body.stamp - 100000000);
  EXPECT_NEAR(length(then.position - before.position), 0.0, 1e-12);
  EXPECT_NEAR(then.orientation.w, 1.0, 1e-12);
  const Pose later = poseAt(body, body.stamp + 1000);
  const Vec3 point(0.4, -0.2, 0.9);
  const Vec3 fixed = rotate(conjugate(body.pose.orientation), Vec3(point - body.pose.position));
  const Vec3 moved = later.position + rotate(later.orientation, fixed);
  // The displacement of one microsecond is exact up to its square.
  EXPECT_NEAR(length(velocityAt(body, body.pose, point) - (moved - point) / 1e-6), 0.0, 1e-4);
}

TEST(ContactBody, FaultsNameBodyValueAndRange) {
  EXPECT_EQ(faultsOf(capsule()), "");
  Body body = capsule();
  body.size = Vec3(0.0, 0.0, -1.0);
  EXPECT_EQ(faultsOf(body),
            "body 'arm'.length = -1 m is outside 0 to 50 m\n"
            "body 'arm'.radius = 0 m is outside 0.001 to 50 m");
  body = capsule();
  body.shape = static_cast<Shape>(7);
  EXPECT_EQ(faultsOf(body), "body 'arm'.shape = 7 is none of 0 (sphere), 1 (capsule), 2 (box)");
  body = capsule();
  body.pose.orientation = {2.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(faultsOf(body), "body 'arm'.orientation's norm = 2 is outside 0.999 to 1.001");
  body = capsule();
  body.in_frame.orientation = {1e-300, 0.0, 0.0, 0.0};
  EXPECT_EQ(faultsOf(body), "body 'arm'.offset.orientation's norm = 0 is outside 0.999 to 1.001");
  body = capsule();
  body.velocity.y() = std::nan("");
  EXPECT_NE(faultsOf(body).find("velocity"), std::string::npos);
  body = capsule();
  body.id.clear();
  EXPECT_EQ(faultsOf(body), "body.id is empty");
}

}  // namespace
}  // namespace vegetation_sim::forest
