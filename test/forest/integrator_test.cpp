// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/integrator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

std::vector<PhysicalBranch> smallOak(double damping_ratio) {
  Species species = shippedSpecies("oak");
  species.limbs.resize(3);
  species.limbs[1].children = 4;
  species.limbs[2].children = 3;
  TreeSeed seed;
  seed.seed = 3;
  return beamTree(grow(seed, species), species, damping_ratio);
}

PhysicalState atRest(std::size_t n) {
  return {std::vector<Eigen::Vector2d>(n, Eigen::Vector2d::Zero()),
          std::vector<Eigen::Vector2d>(n, Eigen::Vector2d::Zero())};
}

/// A smooth push on every branch for one second.
LoadFunction gust(double strength) {
  return [strength](const Kinematics&, double t, std::vector<Wrench>& loads) {
    const double s = t < 1.0 ? std::sin(M_PI * t) : 0.0;
    for (Wrench& load : loads) load.force = Vec3(strength * s * s, 0.3 * strength * s * s, 0.0);
  };
}

std::vector<Vec3> tipsAfter(Integrator integrator, double seconds, double h, double strength) {
  const auto tree = smallOak(0.1);
  PhysicalState state = atRest(tree.size());
  TreeStepper stepper(integrator);
  const int steps = static_cast<int>(std::lround(seconds / h));
  for (int i = 0; i < steps; ++i) stepper.step(tree, gust(strength), i * h, h, state);
  const Kinematics k = kinematicsOf(tree, state);
  std::vector<Vec3> out;
  for (const Pose& pose : k.pose) out.push_back(pose.position);
  return out;
}

double rms(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// One joint: stiffness w^2, damping c, unit inertia.
std::vector<PhysicalBranch> oneJoint(double w, double c) {
  PhysicalBranch b;
  b.mass = 3.0;
  b.inertia_across = 1.0;
  b.stiffness = w * w;
  b.damping = c;
  return {b};
}

bool staysBounded(Integrator integrator, double w, double c, double h) {
  const auto tree = oneJoint(w, c);
  PhysicalState state = atRest(1);
  state.q[0].x() = 1e-5;
  TreeStepper stepper(integrator);
  for (int i = 0; i < 500000 && state.q[0].norm() > 1e-12; ++i) {
    stepper.step(tree, nullptr, 0.0, h, state);
    if (!(std::fabs(state.q[0].x()) < 1e-3)) return false;
  }
  return true;
}

// S1-33, E12: explicit Euler as printed is stable below dt = beta = c / w^2, and not above.
TEST(Integrator, ExplicitEulerBreaksAtItsBound) {
  const double w = 50.0;
  for (const double beta : {0.002, 0.004, 0.01}) {
    EXPECT_TRUE(staysBounded(Integrator::EXPLICIT_EULER, w, beta * w * w, 0.98 * beta)) << beta;
    EXPECT_FALSE(staysBounded(Integrator::EXPLICIT_EULER, w, beta * w * w, 1.02 * beta)) << beta;
  }
  EXPECT_FALSE(staysBounded(Integrator::EXPLICIT_EULER, w, 0.0, 0.005));
}

// E12: semi-implicit Euler is stable while h^2 w^2 + 2 h c < 4.
TEST(Integrator, SemiImplicitEulerBreaksAtItsBound) {
  const double w = 50.0;
  for (const double c : {0.0, 5.0, 20.0}) {
    const double bound = (-c + std::sqrt(c * c + 4.0 * w * w)) / (w * w);
    EXPECT_TRUE(staysBounded(Integrator::SEMI_IMPLICIT_EULER, w, c, 0.98 * bound)) << c;
    EXPECT_FALSE(staysBounded(Integrator::SEMI_IMPLICIT_EULER, w, c, 1.02 * bound)) << c;
  }
}

// S1-W4: implicit methods hold at a hundred times the explicit bound and far beyond.
TEST(Integrator, ImplicitMethodsHoldAtAnyStep) {
  for (const Integrator integrator : {Integrator::MIDPOINT, Integrator::IMPLICIT_EULER})
    for (const double h : {1e-4, 1e-2, 0.1, 1.0})
      EXPECT_TRUE(staysBounded(integrator, 50.0, 2.5, h)) << h;
}

// The default's error falls with the square of the step, against Runge and Kutta's converged.
TEST(Integrator, MidpointIsSecondOrder) {
  const auto reference = tipsAfter(Integrator::RUNGE_KUTTA_4, 0.5, 0.5 / 8192, 30.0);
  const double coarse = rms(tipsAfter(Integrator::MIDPOINT, 0.5, 0.5 / 512, 30.0), reference);
  const double fine = rms(tipsAfter(Integrator::MIDPOINT, 0.5, 0.5 / 1024, 30.0), reference);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

TEST(Integrator, ImplicitEulerIsFirstOrder) {
  const auto reference = tipsAfter(Integrator::RUNGE_KUTTA_4, 0.5, 0.5 / 8192, 30.0);
  const double coarse =
      rms(tipsAfter(Integrator::IMPLICIT_EULER, 0.5, 0.5 / 1024, 30.0), reference);
  const double fine = rms(tipsAfter(Integrator::IMPLICIT_EULER, 0.5, 0.5 / 2048, 30.0), reference);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.15);
}

// Energy: kept by the reference without damping, only lost with it.
TEST(Integrator, EnergyIsConservedAndDamped) {
  for (const double ratio : {0.0, 0.1}) {
    const auto tree = smallOak(ratio);
    PhysicalState state = atRest(tree.size());
    for (std::size_t i = 0; i < tree.size(); ++i) state.q[i] = Eigen::Vector2d(0.02, -0.01);
    const double start = energyOf(tree, state);
    double before = start;
    TreeStepper stepper(Integrator::RUNGE_KUTTA_4);
    for (int i = 0; i < 400; ++i) {
      stepper.step(tree, nullptr, 0.0, 2e-5, state);
      const double now = energyOf(tree, state);
      EXPECT_LE(now, before * (1.0 + 1e-9));
      before = now;
    }
    if (ratio == 0.0) {
      EXPECT_NEAR(before / start, 1.0, 1e-6);
    } else {
      EXPECT_LT(before / start, 0.9);
    }
  }
}

// S1-W4, S1-42: a storm of thirty times the gust at steps up to 50 ms leaves the tree bounded, and
// it comes back to rest; the guard acts there and not in normal use.
TEST(Integrator, GuardedMidpointSurvivesAStorm) {
  const auto tree = smallOak(0.1);
  for (const double h : {1.0 / 240, 1.0 / 60, 0.05}) {
    PhysicalState state = atRest(tree.size());
    TreeStepper stepper(Integrator::MIDPOINT);
    double largest = 0.0, theta = 0.5;
    for (double t = 0.0; t < 12.0; t += h) {
      stepper.step(tree, gust(30.0 * 60.0), t, h, state);
      theta = std::max(theta, stepper.theta());
      for (const Eigen::Vector2d& q : state.q) largest = std::max(largest, q.norm());
    }
    EXPECT_LT(largest, 20.0) << h;
    for (const Eigen::Vector2d& q : state.q) EXPECT_LT(q.norm(), 0.02) << h;
    if (h > 0.01) {
      EXPECT_EQ(theta, 1.0) << h;
    }
  }
  TreeStepper calm(Integrator::MIDPOINT);
  PhysicalState state = atRest(tree.size());
  for (double t = 0.0; t < 1.0; t += 1.0 / 240) {
    calm.step(tree, gust(10.0), t, 1.0 / 240, state);
    EXPECT_EQ(calm.theta(), 0.5);
  }
}

}  // namespace
}  // namespace vegetation_sim::forest
