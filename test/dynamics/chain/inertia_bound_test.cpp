// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/inertia_bound.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_scene.h"

namespace vegetation_sim::physics {
namespace {

double kineticOf(std::vector<Link> links, const ChainState& state) {
  for (Link& link : links) link.stiffness = 0.0;
  return energyOf(links, state, kinematicsAt(links, state));
}

double sureEnergy(const std::vector<Link>& links, const ChainState& state) {
  double out = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i)
    out += 0.5 * links[i].guaranteed_inertia * state.rate[i].squaredNorm();
  return out;
}

// The bound holds for any motion: of one joint, of all at once, of a twig against all others, at
// bends up to 0.8 rad.
TEST(GuaranteedInertia, IsNeverMoreThanTheTreeHas) {
  for (const auto& links : {crown(63, 0.1), fractalTree(100, 3), beam(40, 3.0, 0.01, 8e9, 900.0)}) {
    double most = 0.0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      ChainState state = randomState(links.size(), seed % 2 ? 0.5 : 0.0, 1.0, seed);
      for (std::size_t i = 0; i < links.size(); ++i) {
        if (seed % 3 == 0 && i % (seed % 7 + 2) != 0) state.rate[i] = Vec2::Zero();
        if (seed % 3 == 1) state.rate[i] /= std::sqrt(links[i].guaranteed_inertia);
      }
      most = std::max(most, sureEnergy(links, state) / kineticOf(links, state));
    }
    EXPECT_LT(most, 1.0);
    for (const Link& link : links) EXPECT_GT(link.guaranteed_inertia, 0.0);
  }
}

TEST(GuaranteedInertia, OfOneJointIsMostOfIt) {
  std::vector<Link> links{bar(-1, 0.0, 1.0, 0.02, 8e9, 900.0)};
  shareInertia(links);
  EXPECT_NEAR(links[0].guaranteed_inertia / links[0].inertia.xx, 0.8, 1e-12);
}

TEST(GuaranteedInertia, NothingAndMasslessThingsHaveNone) {
  std::vector<Link> links;
  shareInertia(links);
  links.assign(2, Link());
  links[1].parent = 0;
  for (Link& link : links) link.mass = 0.0, link.inertia = Symmetric3();
  shareInertia(links);
  EXPECT_EQ(links[0].guaranteed_inertia, 0.0);
  EXPECT_EQ(links[1].guaranteed_inertia, 0.0);
}

// Returns the angle of a joint of 3 rad/s, released at 1e-3 rad, after `seconds` in `steps`.
double angleAfter(double seconds, int steps, bool eased) {
  Link link;
  link.stiffness = 9.0;
  std::vector<Link> links{link};
  if (eased) shareInertia(links);
  Simulation run{links};
  run.state.q[0].x() = 1e-3;
  for (int i = 0; i < steps; ++i) run.step({}, 0.0, seconds / steps);
  return run.state.q[0].x();
}

// Without it the period is correct to second order only.
TEST(GuaranteedInertia, MakesSlowMotionFourthOrder) {
  const double exact = 1e-3 * std::cos(15.0);
  const auto error = [&](int steps, bool eased) {
    return std::fabs(angleAfter(5.0, steps, eased) - exact);
  };
  EXPECT_NEAR(std::log2(error(100, true) / error(200, true)), 4.0, 0.2);
  EXPECT_NEAR(std::log2(error(100, false) / error(200, false)), 2.0, 0.2);
  EXPECT_LT(error(100, true), 0.02 * error(100, false));
}

// Small motion without any damper never grows, at any step, however stiff the twigs.
TEST(GuaranteedInertia, LeavesTheMidpointStableAtAnyStep) {
  for (std::vector<Link> links : {crown(63, 0.0), fractalTree(100, 3)}) {
    for (Link& link : links) link.damping = 0.0;
    for (const double h : {5e-4, 1e-3, 2e-3, 1.0 / 240.0, 0.008, 1.0 / 60.0, 0.05, 0.5}) {
      Simulation run{links};
      run.state = randomState(links.size(), 1e-7, 0.0, 3);
      for (int i = 0; i < 3000; ++i) run.step({}, 0.0, h);
      for (std::size_t i = 0; i < links.size(); ++i) EXPECT_LT(run.state.q[i].norm(), 3e-5) << h;
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
