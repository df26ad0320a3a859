// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

/// A pole: one upright branch, 2 m long, leaning by phi.
Species pole() {
  Species out;
  out.name = "pole";
  out.height = 2.0;
  out.height_variation = out.lean = out.noise = 0.0;
  out.trunk_radius = 0.05;
  out.limbs = {LimbRule{}};
  out.limbs[0].segments = 1;
  out.limbs[0].taper = 1.0;
  return out;
}

Skeleton poleSkeleton(double theta, double phi) {
  Skeleton out = grow(TreeSeed{}, pole());
  out.branches[0].theta = theta;
  out.branches[0].phi = phi;
  out.branches[0].turn = restRotation(theta, phi);
  out.branches[0].rest.orientation = restRotation(theta, phi);
  return out;
}

MotionLaw lawOf(JointModel joint, Gain gain) {
  MotionLaw out;
  out.joint_model = joint;
  out.gain = gain;
  return out;
}

// S1-18, E3: torque = L z x f, f at the tip; with 1/m it is the printed angle (S1-19).
TEST(Response, PaperGainIsTorqueOverMass) {
  const Skeleton skeleton = poleSkeleton(0.3, 0.2);
  const Branch& b = skeleton.branches[0];
  const auto response = windResponse(skeleton, pole(), lawOf(JointModel::PAPER, Gain::PAPER));
  const Vec3 f(1.0, 0.4, -0.2), z = axisZ(b.rest.orientation), y = axisY(b.rest.orientation);
  const Vec3 torque = b.length * z.cross(f);
  const double mass = pole().density * PI * 0.05 * 0.05 * 2.0;
  EXPECT_NEAR(dot(response[0].first, f), PAPER_GAIN / mass * torque.z(), 1e-15);
  EXPECT_NEAR(dot(response[0].second, f), PAPER_GAIN / mass * torque.dot(y), 1e-15);
}

// S1-18 as printed in numbers: z = (0, 0, 1), L = 2, f = (1, 0, 0) -> torque (0, 2, 0).
TEST(Response, TorqueOfAnUprightPole) {
  const Skeleton skeleton = poleSkeleton(0.0, 0.0);
  const auto response = windResponse(skeleton, pole(), lawOf(JointModel::SWING, Gain::PAPER));
  const double mass = pole().density * PI * 0.05 * 0.05 * 2.0;
  const Vec3 f(1.0, 0.0, 0.0);
  EXPECT_NEAR(dot(response[0].first, f) * mass / PAPER_GAIN, 0.0, 1e-12);
  EXPECT_NEAR(dot(response[0].second, f) * mass / PAPER_GAIN, 2.0, 1e-12);
}

// The default gain is the static deflection: spring torque = drag torque of the whole sub-tree.
TEST(Response, ComplianceGainBalancesTheDrag) {
  const Species species = shippedSpecies("birch");
  TreeSeed seed;
  seed.seed = 4;
  const Skeleton skeleton = grow(seed, species);
  const auto response = windResponse(skeleton, species, lawOf(JointModel::SWING, Gain::COMPLIANCE));
  const Vec3 wind(3.0, -1.0, 0.5);
  for (const std::size_t joint : {std::size_t{0}, std::size_t{10}, skeleton.branches.size() - 1}) {
    const Branch& b = skeleton.branches[joint];
    Vec3 torque = Vec3::Zero();
    for (std::size_t i = joint; i < skeleton.branches.size(); ++i) {
      int up = static_cast<int>(i);
      while (up > static_cast<int>(joint))
        up = skeleton.branches[static_cast<std::size_t>(up)].parent;
      if (up != static_cast<int>(joint)) continue;
      const Branch& load = skeleton.branches[i];
      const Vec3 middle = 0.5 * (load.rest.position + tipOf(load, load.rest));
      torque += (middle - b.rest.position).cross(dragPerSpeed(load, species) * wind);
    }
    const double k = jointStiffness(b, species);
    EXPECT_NEAR(k * dot(response[joint].first, wind), torque.dot(axisX(b.rest.orientation)),
                1e-9 * torque.norm());
    EXPECT_NEAR(k * dot(response[joint].second, wind), torque.dot(axisY(b.rest.orientation)),
                1e-9 * torque.norm());
  }
}

// S1-20: rotating the force by 90 degrees moves the response from one angle to the other.
TEST(Response, DirectionShowsInTheAngles) {
  const Skeleton skeleton = poleSkeleton(0.0, 0.4);
  const auto response = windResponse(skeleton, pole(), lawOf(JointModel::PAPER, Gain::COMPLIANCE));
  EXPECT_NEAR(dot(response[0].first, Vec3(1, 0, 0)), 0.0, 1e-12);
  EXPECT_GT(std::fabs(dot(response[0].second, Vec3(1, 0, 0))), 1e-6);
  EXPECT_GT(std::fabs(dot(response[0].first, Vec3(0, 1, 0))), 1e-6);
  EXPECT_NEAR(dot(response[0].second, Vec3(0, 1, 0)), 0.0, 1e-12);
}

double tipTravel(JointModel model, double phi, double azimuth) {
  Skeleton skeleton = poleSkeleton(0.0, phi);
  const auto response = windResponse(skeleton, pole(), lawOf(model, Gain::COMPLIANCE));
  const SinCos a = sinCos(azimuth);
  const JointAngles angles = deviation(response[0], Vec3(a.cos, a.sin, 0.0), 1.0, model);
  const Pose bent{Vec3::Zero(), jointRotation(skeleton.branches[0], angles, model)};
  return length(tipOf(skeleton.branches[0], bent) -
                tipOf(skeleton.branches[0], skeleton.branches[0].rest));
}

// E4: anisotropy over 36 wind directions. The response of the printed joint to lateral wind is
// sin^2 phi of the in-plane motion, and zero where a branch continues straight; `swing` is
// isotropic.
TEST(Response, SwingIsIsotropicWherePaperIsDegenerate) {
  for (const double phi : {0.0, 10.0 * PI / 180.0}) {
    double bending_low = 1e9, bending_high = 0.0, paper_low = 1e9, paper_high = 0.0;
    for (int i = 0; i < 36; ++i) {
      const double azimuth = 2.0 * PI * i / 36.0;
      const double swing = tipTravel(JointModel::SWING, phi, azimuth);
      const double paper = tipTravel(JointModel::PAPER, phi, azimuth);
      bending_low = std::min(bending_low, swing);
      bending_high = std::max(bending_high, swing);
      paper_low = std::min(paper_low, paper);
      paper_high = std::max(paper_high, paper);
    }
    const double s = std::sin(phi);
    EXPECT_NEAR(paper_low / paper_high, s * s / std::cos(phi), 0.002) << phi;
    EXPECT_GT(bending_low / bending_high, std::cos(phi) - 0.01)
        << phi;  // cos: inclination of the wind
  }
}

// E16: in any storm every joint stays within its limit, and small angles are exactly linear.
TEST(Response, AnglesAreBounded) {
  Response response;
  response.first = Vec3(0.1, 0.0, 0.0);
  response.second = Vec3(0.0, 0.1, 0.0);
  for (const JointModel model : {JointModel::SWING, JointModel::PAPER}) {
    const JointAngles storm = deviation(response, Vec3(1e6, -1e6, 0.0), 1.0, model);
    EXPECT_LT(std::fabs(storm.first), BEND_LIMIT);
    EXPECT_LT(std::fabs(storm.second), BEND_LIMIT);
    EXPECT_LT(storm.second, 0.0);
    const JointAngles calm = deviation(response, Vec3(2.0, -1.0, 0.0), 1.0, model);
    EXPECT_EQ(calm.first, 0.1 * 2.0);
    EXPECT_EQ(calm.second, 0.1 * -1.0);
  }
}

// S1-A1: joints only bend: no wind rotates a branch about its own axis.
TEST(Response, SwingDoesNotTwist) {
  Skeleton skeleton = poleSkeleton(0.7, 0.5);
  const Branch& b = skeleton.branches[0];
  const Quat bend =
      conjugate(restRotation(b.theta, b.phi)) * jointRotation(b, {0.4, -0.3}, JointModel::SWING);
  EXPECT_NEAR(bend.z, 0.0, 1e-15);
  EXPECT_NEAR(2.0 * std::atan2(std::hypot(bend.x, bend.y), bend.w), 0.5, 1e-12);
}

TEST(Response, QuadraticDragMeetsLinearAtTheReferenceSpeed) {
  const Vec3 v(0.0, 8.0, 0.0);
  EXPECT_EQ(effectiveVelocity(v, Drag::QUADRATIC, 8.0), effectiveVelocity(v, Drag::LINEAR, 8.0));
  EXPECT_DOUBLE_EQ(effectiveVelocity(2.0 * v, Drag::QUADRATIC, 8.0).y(), 4.0 * 8.0);
}

}  // namespace
}  // namespace vegetation_sim::forest
