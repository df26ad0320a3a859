// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/chain/linear_chain.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_fixture.h"

namespace vegetation_sim::physics {
namespace {

constexpr std::size_t LINKS = 60;

std::vector<double> randomVector(std::size_t n, std::uint64_t seed) {
  const Random random(seed);
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = random.uniform(i, -1.0, 1.0);
  return out;
}

// N13: the mass matrix is the one of the full chain's inverse dynamics at rest.
TEST(LinearChain, HasTheMassMatrixOfTheFullChain) {
  const std::vector<Link> links = crown(LINKS, 0.1);
  LinearChain chain(links);
  ASSERT_EQ(chain.size(), 2 * LINKS);
  const ChainState rest = atRest(LINKS);
  Loads none;
  none.clear(LINKS);
  ArticulatedBody body;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::vector<double> x = randomVector(chain.size(), seed);
    std::vector<Vec2> acceleration, torque;
    for (std::size_t i = 0; i < LINKS; ++i) acceleration.emplace_back(x[2 * i], x[2 * i + 1]);
    body.torques(links, {}, rest, kinematicsAt(links, rest), none, acceleration, torque);
    std::vector<double> out(chain.size());
    chain.timesMass(x.data(), out.data());
    for (std::size_t i = 0; i < LINKS; ++i) {
      EXPECT_NEAR(out[2 * i], torque[i].x(), 1e-12 * (1.0 + std::fabs(torque[i].x())));
      EXPECT_NEAR(out[2 * i + 1], torque[i].y(), 1e-12 * (1.0 + std::fabs(torque[i].y())));
    }
  }
}

// The torques of wrenches do the work of the wrenches, for any motion.
TEST(LinearChain, TorquesDoTheWorkOfTheWrenches) {
  const std::vector<Link> links = crown(LINKS, 0.1);
  const LinearChain chain(links);
  const std::vector<double> numbers = randomVector(6 * LINKS, 9), x = randomVector(2 * LINKS, 10);
  std::vector<Wrench> wrenches(LINKS);
  for (std::size_t i = 0; i < LINKS; ++i) {
    const double* n = numbers.data() + 6 * i;
    wrenches[i] = {Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5])};
  }
  const std::vector<double> torque = chain.torquesOf(wrenches);
  std::vector<SmallMotion> motion;
  chain.motionOf(x.data(), motion);
  double of_joints = 0.0, of_links = 0.0;
  for (std::size_t i = 0; i < 2 * LINKS; ++i) of_joints += torque[i] * x[i];
  for (std::size_t i = 0; i < LINKS; ++i)
    of_links += dot(wrenches[i].force, motion[i].move) + dot(wrenches[i].torque, motion[i].turn);
  EXPECT_NEAR(of_joints, of_links, 1e-11 * std::fabs(of_links));
}

// Motion is the derivative of the kinematics.
TEST(LinearChain, MotionIsTheSmallLimitOfTheKinematics) {
  const std::vector<Link> links = crown(LINKS, 0.1);
  const LinearChain chain(links);
  const std::vector<double> x = randomVector(2 * LINKS, 3);
  std::vector<SmallMotion> motion;
  chain.motionOf(x.data(), motion);
  constexpr double SMALL = 1e-5;  // the remainder is quadratic in it, times ten joints
  ChainState bent = atRest(LINKS);
  for (std::size_t i = 0; i < LINKS; ++i) bent.q[i] = SMALL * Vec2(x[2 * i], x[2 * i + 1]);
  const Kinematics k = kinematicsAt(links, bent);
  for (std::size_t i = 0; i < LINKS; ++i)
    EXPECT_LT(length((k.pose[i].position - chain.rest()[i].position) / SMALL - motion[i].move),
              1e-3);
}

}  // namespace
}  // namespace vegetation_sim::physics
