// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/integration/stability.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_fixture.h"

namespace vegetation_sim::physics {
namespace {

constexpr Integrator EXPLICIT[] = {Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER,
                                   Integrator::RUNGE_KUTTA_4};
constexpr int STEPS = 60000;  // enough steps to detect growth by 5e-5 per step

/// Returns whether a released joint with w^2 and c stays bounded.
bool jointHolds(Integrator integrator, double w2, double c, double h) {
  Link link;
  link.stiffness = w2;
  link.damping = c;
  Simulation run{{link}, integrator};
  run.state.q[0].x() = 1e-6;
  double size = 0.0;
  for (int i = 0; i < STEPS; ++i) {
    run.step({}, 0.0, h);
    const double rate = run.state.rate[0].x();
    size = std::sqrt(run.state.q[0].x() * run.state.q[0].x() + rate * rate / w2);
    if (!(size < 1e-5)) return false;
    if (size < 1e-9) return true;
  }
  return true;
}

/// Largest step that holds, by bisection between half and twice the guess.
template <class Holds>
double largestStep(const Holds& holds, double guess) {
  double low = 0.5 * guess, high = 2.0 * guess;
  for (int i = 0; i < 8; ++i) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// E12, N9: the largest stable step of a joint, found by bisection, is that of the theory within 2
// %: eight decades of stiffness, light and over-damped.
TEST(Stability, JointsBreakWhereTheoryHasIt) {
  for (const Integrator integrator : EXPLICIT)
    for (const double w2 : {1.0, 1e4, 1e8})
      for (const double ratio : {0.0, 0.05, 0.3, 0.9, 2.0}) {
        if (ratio == 0.0 && integrator == Integrator::EXPLICIT_EULER) continue;
        const double c = 2.0 * ratio * std::sqrt(w2);
        const double theory = jointLimit(integrator, w2, c);
        const double found =
            largestStep([&](double h) { return jointHolds(integrator, w2, c, h); }, theory);
        EXPECT_NEAR(found / theory, 1.0, 0.02)
            << static_cast<int>(integrator) << " " << w2 << " " << ratio;
      }
}

// E12: as printed without damping, no step is stable; implicit ones have no limit.
TEST(Stability, SomeHaveNoLimitAndSomeNoStep) {
  EXPECT_EQ(jointLimit(Integrator::EXPLICIT_EULER, 2500.0, 0.0), 0.0);
  EXPECT_FALSE(jointHolds(Integrator::EXPLICIT_EULER, 2500.0, 0.0, 1e-3));
  for (const Integrator integrator : {Integrator::MIDPOINT, Integrator::IMPLICIT_EULER}) {
    EXPECT_TRUE(std::isinf(jointLimit(integrator, 1e8, 0.0)));
    EXPECT_TRUE(jointHolds(integrator, 1e8, 10.0, 0.05));
  }
}

/// Returns whether small motion of a chain stays small.
bool treeHolds(Dynamics dynamics, Integrator integrator, const std::vector<Link>& links,
               const Surroundings& outside, double h, int steps) {
  Simulation run{links, integrator};
  run.stepper.setDynamics(dynamics);
  run.state = randomState(links.size(), 1e-6, 0.0, 3);
  double most = 1e-5;
  for (int i = 0; i < steps; ++i) {
    run.step(outside, 0.0, h);
    for (const Vec2& q : run.state.q)
      if (!(q.norm() < 100.0 * most)) return false;
  }
  return true;
}

double guardOf(Dynamics dynamics, Integrator integrator, const std::vector<Link>& links) {
  const Kinematics k = kinematicsAt(links, atRest(links.size()));
  return guardLimit(integrator, guardRates(dynamics, links, k));
}

double estimateOf(Dynamics dynamics, Integrator integrator, const std::vector<Link>& links) {
  const ChainState rest = atRest(links.size());
  const ChainRates guard = guardRates(dynamics, links, kinematicsAt(links, rest));
  if (dynamics != Dynamics::ARTICULATED) return guardLimit(integrator, guard);
  return guardLimit(integrator, tighter(guard, estimatedRates(links, {}, rest, {})));
}

// E12: whole trees are stable at the guard's step, and at the estimate's, for every explicit
// method, dynamics, size and damping; the estimate is at most 3.5 times too careful.
TEST(Stability, GuardHoldsForTrees) {
  double loosest = 1.0;
  for (const Dynamics dynamics : {Dynamics::ARTICULATED, Dynamics::PAPER})
    for (const Integrator integrator : EXPLICIT)
      for (const std::size_t count : {7U, 63U})
        for (const double ratio : {0.02, 0.3}) {
          const std::vector<Link> links = crown(count, ratio);
          const auto holds = [&](double h) {
            return treeHolds(dynamics, integrator, links, {}, h, count < 10 ? 4000 : 1000);
          };
          const auto name = [&] {
            return testing::Message()
                   << static_cast<int>(dynamics) << " " << static_cast<int>(integrator) << " "
                   << count << " " << ratio;
          };
          const double estimate = estimateOf(dynamics, integrator, links);
          EXPECT_LE(guardOf(dynamics, integrator, links), estimate) << name();
          EXPECT_TRUE(holds(guardOf(dynamics, integrator, links))) << name();
          EXPECT_TRUE(holds(estimate)) << name();
          double high = 1.1 * estimate;
          while (holds(high) && high < 10.0 * estimate) high *= 1.1;
          loosest = std::max(loosest, high / estimate);
        }
  RecordProperty("largest_stable_over_estimate", std::to_string(loosest));
  EXPECT_LT(loosest, 3.5);  // explicit Euler: beta of the least damped joint
}

// For a single joint the guard is the theory.
TEST(Stability, GuardOfOneJointIsExact) {
  const std::vector<Link> links{bar(-1, 0.0, 1.0, 0.02, 8e9, 900.0)};
  const double w2 = links[0].stiffness / links[0].inertia.xx;
  for (const Dynamics dynamics : {Dynamics::ARTICULATED, Dynamics::PAPER})
    EXPECT_NEAR(guardOf(dynamics, Integrator::SEMI_IMPLICIT_EULER, links) /
                    jointLimit(Integrator::SEMI_IMPLICIT_EULER, w2, 0.0),
                1.0, 1e-9);
}

/// A spring at the tip of the last link.
Surroundings heldTip(const std::vector<Link>& links, double stiffness, double damping) {
  const Vec3 rest = [&] {
    const Kinematics k = kinematicsAt(links, atRest(links.size()));
    return Vec3(k.pose.back().position + links.back().length * axisZ(k.pose.back().orientation));
  }();
  Surroundings out;
  out.loads = [&links, rest, stiffness, damping](const Kinematics& k, double, Loads& loads) {
    const std::size_t i = links.size() - 1;
    Anchor anchor;
    anchor.link = static_cast<int>(i);
    anchor.arm = links[i].length * axisZ(k.pose[i].orientation);
    anchor.force = stiffness * (rest - k.pose[i].position - anchor.arm) -
                   damping * (k.velocity[i] + cross(k.spin[i], anchor.arm));
    anchor.stiffness = {stiffness, stiffness, stiffness, 0.0, 0.0, 0.0};
    anchor.damping = {damping, damping, damping, 0.0, 0.0, 0.0};
    loads.anchors.push_back(anchor);
  };
  return out;
}

// An explicit method whose step would be unstable is run in parts, and beyond so many rejected with
// nothing changed; a stiff grab counts too.
TEST(Stability, ExplicitMethodsAreSubSteppedOrRefused) {
  const std::vector<Link> links = crown(63, 0.1);
  const Surroundings held = heldTip(links, 5000.0, 20.0);
  ChainStepper stepper;
  for (const Integrator integrator : EXPLICIT) {
    ChainState state = randomState(63, 0.05, 0.1, 3);
    const ChainState before = state;
    double theta = 0.5;
    EXPECT_EQ(stepper.step(integrator, links, {}, 0.0, 10.0, state, theta), 0);
    for (std::size_t i = 0; i < 63; ++i) {
      EXPECT_EQ(state.q[i], before.q[i]);
      EXPECT_EQ(state.rate[i], before.rate[i]);
    }
    const double limit = estimateOf(Dynamics::ARTICULATED, integrator, links);
    const int free = stepper.step(integrator, links, {}, 0.0, 5.0 * limit, state, theta);
    EXPECT_GE(free, 5);
    EXPECT_LE(free, MOST_SUB_STEPS);
    state = before;
    const int grabbed = stepper.step(integrator, links, held, 0.0, 5.0 * limit, state, theta);
    EXPECT_TRUE(grabbed > free || grabbed == 0);
  }
  ChainState state = atRest(63);
  double theta = 0.5;
  EXPECT_EQ(stepper.step(Integrator::MIDPOINT, links, held, 0.0, 10.0, state, theta), 1);
  std::vector<Link> undamped = crown(7, 0.0);
  state = atRest(7);
  EXPECT_EQ(stepper.step(Integrator::EXPLICIT_EULER, undamped, {}, 0.0, 1e-6, state, theta), 0);
}

// The limit holds for small motion only: at 60 rad/s a joint turns by 0.25 rad in a step, and a
// scene of fuzzing diverged.
TEST(Stability, ExplicitMethodsRunFastTurnsInParts) {
  const std::vector<Link> links = crown(7, 0.1);
  ChainStepper stepper;
  for (const Integrator integrator : EXPLICIT) {
    ChainState state = atRest(7);
    double theta = 0.5;
    const double h = 0.5 * estimateOf(Dynamics::ARTICULATED, integrator, links);
    EXPECT_EQ(stepper.step(integrator, links, {}, 0.0, h, state, theta), 1);
    state = atRest(7);
    state.rate[3] = {3.5 * GUARD_TURN / h, 0.0};
    EXPECT_EQ(stepper.step(integrator, links, {}, 0.0, h, state, theta), 4);
    state = atRest(7);
    state.rate[3] = {100.0 * GUARD_TURN / h, 0.0};
    EXPECT_EQ(stepper.step(integrator, links, {}, 0.0, h, state, theta), 0);
  }
}

// A torque that the limit does not see, as of a twig that is let go: within one step its joint
// would turn by radians. Below, the step is taken; beyond, it is rejected with nothing changed.
TEST(Stability, ExplicitMethodsRefuseStepsThatALoadMakesTooFast) {
  const std::vector<Link> links = crown(7, 0.1);
  ChainStepper stepper;
  for (const Integrator integrator : EXPLICIT) {
    const double h = 0.5 * estimateOf(Dynamics::ARTICULATED, integrator, links);
    const auto partsUnder = [&](double torque, ChainState& state) {
      Surroundings outside;
      outside.loads = [torque](const Kinematics&, double, Loads& loads) {
        loads.joint_torque.back().x() += torque;
      };
      double theta = 0.5;
      return stepper.step(integrator, links, outside, 0.0, h, state, theta);
    };
    ChainState state = atRest(7);
    ASSERT_EQ(partsUnder(1e-3, state), 1);
    const double turn = std::fabs(state.rate.back().x()) * h;
    ASSERT_GT(turn, 0.0);
    state = atRest(7);
    EXPECT_EQ(partsUnder(1e-3 * 0.5 * WILD_TURN / turn, state), 1);
    state = atRest(7);
    EXPECT_EQ(partsUnder(1e-3 * 2.0 * WILD_TURN / turn, state), 0);
    for (std::size_t i = 0; i < state.q.size(); ++i) {
      EXPECT_EQ(state.q[i], Vec2(0.0, 0.0));
      EXPECT_EQ(state.rate[i], Vec2(0.0, 0.0));
    }
  }
}

// Run in parts, explicit methods survive a gust at 60 Hz that would break them at once.
TEST(Stability, RuleKeepsExplicitMethodsAlive) {
  const std::vector<Link> links = crown(31, 0.1);
  const Surroundings outside = gust(links, 3.0);
  ChainStepper stepper;
  for (const Integrator integrator : {Integrator::SEMI_IMPLICIT_EULER, Integrator::RUNGE_KUTTA_4}) {
    ChainState state = atRest(31);
    double theta = 0.5;
    for (int i = 0; i < 120; ++i) {
      ASSERT_GT(stepper.step(integrator, links, outside, i / 60.0, 1.0 / 60.0, state, theta), 0);
      for (const Vec2& q : state.q) ASSERT_LT(q.norm(), 1.5);
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
