// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// N9, E12: tests each boundary that docs/physics.md and docs/accuracy.md state, from both sides.
#include <gtest/gtest.h>

#include "dynamics/integration/stability.h"
#include "scenes/dynamics/chain_fixture.h"
#include "trees/test_trees.h"

namespace vegetation_sim::physics {
namespace {

Link joint(double w2, double c) {
  Link out;
  out.stiffness = w2;
  out.damping = c;
  return out;
}

/// A chain whose first joint turns at `rate`.
ChainState turning(std::size_t links, double rate) {
  ChainState out = atRest(links);
  out.rate[0].x() = rate;
  return out;
}

// "when it turns more than 0.2 rad in a step: theta = 1; after that theta = max(1/2, 0.9 theta)".
TEST(Boundary, MidpointFallsBackAboveItsTurnAndComesBack) {
  const double h = 0.01;
  EXPECT_EQ(guardedTheta(turning(3, 0.199 / h), h, 0.5), 0.5);
  EXPECT_EQ(guardedTheta(turning(3, 0.201 / h), h, 0.5), 1.0);
  EXPECT_EQ(guardedTheta(turning(3, -0.201 / h), h, 0.5), 1.0);
  double theta = 1.0;
  for (int i = 1; i <= 6; ++i)
    EXPECT_NEAR(theta = guardedTheta(atRest(3), h, theta), std::pow(0.9, i), 1e-12);
  EXPECT_EQ(guardedTheta(atRest(3), h, theta), 0.5);
}

// "more than 0.5 rad in a step: velocity products are left out".
TEST(Boundary, VelocityProductsGoAboveTheirTurn) {
  EXPECT_EQ(productsOf(turning(3, 49.9), 0.01), 1.0);
  EXPECT_EQ(productsOf(turning(3, 50.1), 0.01), 0.0);
}

// "bends beyond 3 rad, or turns more than 1 rad in a step: it stops there".
TEST(Boundary, JointsStopAtTheirBendAndTurn) {
  const auto stopped = [](double bend, double rate) {
    ChainState state = turning(1, rate);
    state.q[0] = Vec2(0.6 * bend, 0.8 * bend);
    stopJoints(0.01, state);
    return std::make_pair(state.q[0].norm(), state.rate[0].x());
  };
  EXPECT_EQ(stopped(2.999, 99.0).second, 99.0);
  EXPECT_NEAR(stopped(2.999, 99.0).first, 2.999, 1e-12);
  EXPECT_NEAR(stopped(3.001, 0.0).first, 3.0, 1e-12);
  EXPECT_LT(stopped(3.001, 50.0).second, 50.0);  // nothing outwards is left
  EXPECT_EQ(stopped(0.1, 99.9).second, 99.9);
  EXPECT_NEAR(stopped(0.1, 100.1).second, 100.0, 1e-9);
}

// "kappa = 1/12 is stable to w h = 2.4 only": a joint that is eased in full, without a damper.
TEST(Boundary, AFullyEasedSpringBreaksWhereNumerovDoes) {
  const auto swing = [](double h) {
    Link link = joint(1.0, 0.0);
    link.guaranteed_inertia = 1e9;  // more than the link has, which shareInertia() would never set
    Simulation run{{link}};
    run.state.q[0].x() = 1e-9;
    for (int i = 0; i < 300; ++i) run.step({}, 0.0, h);
    return run.state.q[0].norm();
  };
  EXPECT_LT(swing(2.40), 1e-7);
  EXPECT_GT(swing(2.50), 1e-3);
}

// "an explicit method whose step exceeds 0.9 of its limit runs in equal parts, up to 64; beyond
// that the step is refused".
TEST(Boundary, StepsArePartedAboveTheMarginAndRefusedAboveSixtyFourParts) {
  const std::vector<Link> links{joint(100.0, 2.0)};
  for (const Integrator integrator :
       {Integrator::SEMI_IMPLICIT_EULER, Integrator::EXPLICIT_EULER, Integrator::RUNGE_KUTTA_4}) {
    const ChainRates rates =
        guardRates(Dynamics::ARTICULATED, links, kinematicsAt(links, atRest(1)));
    const double part = GUARD_MARGIN * guardLimit(integrator, rates);
    const auto parts = [&](double h) {
      ChainState state = turning(1, 0.1);
      double theta = 0.5;
      return ChainStepper().step(integrator, links, {}, 0.0, h, state, theta);
    };
    EXPECT_EQ(parts(0.999 * part), 1);
    EXPECT_EQ(parts(1.001 * part), 2);
    EXPECT_EQ(parts(63.99 * part), 64);
    EXPECT_EQ(parts(64.01 * part), 0);
  }
}

/// Returns whether a released joint of w = 1 is smaller after so many steps of Runge-Kutta.
bool rungeKuttaHolds(double ratio, double h) {
  Simulation run{{joint(1.0, 2.0 * ratio)}, Integrator::RUNGE_KUTTA_4};
  run.state.q[0] = Vec2(1e-9, 0.0);
  run.state.rate[0] = Vec2(0.7e-9, 0.0);
  for (int i = 0; i < 5000; ++i) {
    run.step({}, 0.0, h);
    if (!(run.state.q[0].norm() < 1e-6)) return false;
  }
  return true;
}

// "Runge-Kutta 4: a half-disc of radius 2.6155 lies inside its region", and no larger one.
TEST(Boundary, HalfDiskOfRungeKuttaIsInsideAndASlightlyLargerOneIsNot) {
  bool larger = true;
  for (double ratio = 0.0; ratio < 1.0; ratio += 0.02) {
    EXPECT_TRUE(rungeKuttaHolds(ratio, 2.6155)) << ratio;
    larger = larger && rungeKuttaHolds(ratio, 2.618);
  }
  EXPECT_FALSE(larger);
}

double largestEnergy(double damping_ratio, double h) {
  Simulation run{crown(127, damping_ratio)};
  for (Vec2& q : run.state.q) q = Vec2(0.02, 0.0);
  double start = 0.0, most = 0.0;
  for (int i = 0; i * h < 10.0; ++i) {
    const double now = energyOf(run.links, run.state, kinematicsAt(run.links, run.state));
    if (i == 0) start = now;
    most = std::max(most, now / start);
    run.step({}, 0.0, h);
  }
  return most;
}

// "Without dampers velocity products feed energy", less so in shorter steps; with a damping ratio
// of 2 % they do not.
TEST(Boundary, MidpointGainsEnergyOnlyWithoutDampers) {
  const double tick = largestEnergy(0.0, 1.0 / 240.0), fine = largestEnergy(0.0, 1e-3);
  RecordProperty("gain_at_240_Hz", std::to_string(tick));
  RecordProperty("gain_at_1_ms", std::to_string(fine));
  EXPECT_GT(tick, 1.02);
  EXPECT_GT(tick, fine);
  EXPECT_LT(largestEnergy(0.02, 1.0 / 240.0), 1.01);
}

std::vector<Link> linksOf(const bench::TestTree& tree) {
  std::vector<Link> out;
  for (const bench::TestLink& from : tree.links) {
    Link link;
    link.parent = from.parent;
    link.h = from.h;
    link.rest = from.rest;
    link.length = from.length;
    link.mass = from.mass;
    link.centre = Vec3(0.0, 0.0, 0.5 * from.length);
    link.inertia = {from.across, from.across, from.along, 0.0, 0.0, 0.0};
    link.stiffness = from.stiffness;
    link.damping = from.damping;
    out.push_back(link);
  }
  return out;
}

bool smallMotionHolds(Integrator integrator, const std::vector<Link>& links, double h) {
  Simulation run{links, integrator};
  run.state = randomState(links.size(), 1e-6, 0.0, 3);
  for (int i = 0; i < 16000; ++i) {
    run.step({}, 0.0, h);
    for (const Vec2& q : run.state.q)
      if (!(q.norm() < 1e-3)) return false;
  }
  return true;
}

// docs/accuracy.md: the steps up to which methods are stable on the fractal tree of 100 branches.
TEST(Boundary, MethodsBreakWhereTheGuideToAccuracySays) {
  const std::vector<Link> links = linksOf(bench::fractalTree(100));
  const std::pair<Integrator, double> stated[] = {{Integrator::SEMI_IMPLICIT_EULER, 3.4e-3},
                                                  {Integrator::EXPLICIT_EULER, 0.87e-3},
                                                  {Integrator::RUNGE_KUTTA_4, 6.7e-3}};
  for (const auto& [integrator, h] : stated) {
    EXPECT_TRUE(smallMotionHolds(integrator, links, 0.96 * h)) << static_cast<int>(integrator);
    EXPECT_FALSE(smallMotionHolds(integrator, links, 1.04 * h)) << static_cast<int>(integrator);
  }
  for (const Integrator integrator : {Integrator::MIDPOINT, Integrator::IMPLICIT_EULER})
    EXPECT_TRUE(smallMotionHolds(integrator, links, 0.5)) << static_cast<int>(integrator);
}

/// A spring of 5 kN/m between the last link's tip and its rest, with a little damping.
Surroundings stiffHand(const std::vector<Link>& links) {
  const Kinematics rest = kinematicsAt(links, atRest(links.size()));
  const std::size_t i = links.size() - 1;
  const Vec3 target = rest.pose[i].position + links[i].length * axisZ(rest.pose[i].orientation);
  Surroundings out;
  out.loads = [&links, target, i](const Kinematics& k, double, Loads& loads) {
    Anchor anchor;
    anchor.link = static_cast<int>(i);
    anchor.arm = links[i].length * axisZ(k.pose[i].orientation);
    anchor.force = 5000.0 * (target - k.pose[i].position - anchor.arm) -
                   1.0 * (k.velocity[i] + cross(k.spin[i], anchor.arm));
    anchor.stiffness = {5000.0, 5000.0, 5000.0, 0.0, 0.0, 0.0};
    anchor.damping = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    loads.anchors.push_back(anchor);
  };
  return out;
}

// "stable at 1/240 s with 5 kN/m on a twig of a gram", where explicit methods are not.
TEST(Boundary, StiffHandsHoldAtTheTickImplicitlyAndBreakExplicitly) {
  const std::vector<Link> links = crown(255, 0.1);
  const Surroundings outside = stiffHand(links);
  for (const Integrator integrator : {Integrator::MIDPOINT, Integrator::SEMI_IMPLICIT_EULER}) {
    Simulation run{links, integrator};
    run.state = randomState(links.size(), 1e-5, 0.0, 3);
    double largest = 0.0;
    for (int i = 0; i < 240 && largest < 0.1; ++i) {
      run.step(outside, 0.0, 1.0 / 240.0);
      for (const Vec2& q : run.state.q) largest = std::max(largest, q.norm());
    }
    EXPECT_EQ(largest < 1e-3, integrator == Integrator::MIDPOINT) << largest;
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
