// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/physical_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

#include "forest/forest_fixture.h"
#include "vegetation_sim/common/random.h"
#include "vegetation_sim/forest/integrator.h"

namespace vegetation_sim::forest {
namespace {

/// A straight upright beam of `n` equal pieces; every joint but the root's stands for a whole
/// piece, the root's for half of one, so that the chain is second order in 1/n.
std::vector<PhysicalBranch> beam(int n, double length, double radius, double modulus,
                                 double density) {
  const double l = length / n, mass = density * M_PI * radius * radius * l;
  std::vector<PhysicalBranch> out(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    PhysicalBranch& b = out[static_cast<std::size_t>(i)];
    b.parent = i - 1;
    b.h = i ? l : 0.0;
    b.length = l;
    b.mass = mass;
    b.centre = 0.5 * l;
    b.inertia_across = mass * l * l / 3.0;
    b.inertia_along = 0.5 * mass * radius * radius;
    b.stiffness = modulus * M_PI * std::pow(radius, 4) / (4.0 * l) * (i ? 1.0 : 2.0);
  }
  return out;
}

std::vector<PhysicalBranch> shrub(double damping_ratio) {
  Species species = shippedSpecies("oak");
  species.limbs.resize(2);
  species.limbs[0].segments = 3;
  species.limbs[1].segments = 2;
  species.limbs[1].children = 4;
  TreeSeed seed;
  seed.seed = 8;
  return beamTree(grow(seed, species), species, damping_ratio);
}

PhysicalState randomState(std::size_t n, double angle, double rate, std::uint64_t seed) {
  const Random random(seed);
  PhysicalState out;
  for (std::uint64_t i = 0; i < n; ++i) {
    out.q.emplace_back(random.uniform(4 * i, -angle, angle),
                       random.uniform(4 * i + 1, -angle, angle));
    out.rate.emplace_back(random.uniform(4 * i + 2, -rate, rate),
                          random.uniform(4 * i + 3, -rate, rate));
  }
  return out;
}

PhysicalState atRest(std::size_t n) {
  return {std::vector<Eigen::Vector2d>(n, Eigen::Vector2d::Zero()),
          std::vector<Eigen::Vector2d>(n, Eigen::Vector2d::Zero())};
}

double kinetic(std::vector<PhysicalBranch> tree, const PhysicalState& state) {
  for (PhysicalBranch& b : tree) b.stiffness = 0.0;
  return energyOf(tree, state);
}

/// Generalised momentum dT/d(rate) of coordinate c, T being quadratic in the rates: exact.
double momentum(const std::vector<PhysicalBranch>& tree, PhysicalState state, std::size_t c) {
  double& rate = state.rate[c / 2][static_cast<int>(c % 2)];
  const double here = rate;
  rate = here + 0.5;
  const double up = kinetic(tree, state);
  rate = here - 0.5;
  return up - kinetic(tree, state);
}

// S1-30: the full chain's equations of motion against Lagrange's, from the kinetic energy alone:
// d/dt dT/d(rate) - dT/dq = spring + damper, at large angles and rates.
TEST(PhysicalTree, ObeysLagrangesEquations) {
  const std::vector<PhysicalBranch> tree = shrub(0.1);
  const PhysicalState state = randomState(tree.size(), 0.7, 3.0, 5);
  const auto a = articulatedAccelerations(tree, state, std::vector<Wrench>(tree.size()));
  const double e = 1e-7;  // [s] far below the period of the stiffest twig
  PhysicalState later = state, earlier = state;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    later.q[i] += e * state.rate[i] + 0.5 * e * e * a[i];
    later.rate[i] += e * a[i];
    earlier.q[i] += -e * state.rate[i] + 0.5 * e * e * a[i];
    earlier.rate[i] -= e * a[i];
  }
  double scale = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i)
    scale = std::max(scale, tree[i].stiffness * state.q[i].norm());
  for (std::size_t c = 0; c < 2 * tree.size(); ++c) {
    const std::size_t i = c / 2;
    const int axis = static_cast<int>(c % 2);
    const double change = (momentum(tree, later, c) - momentum(tree, earlier, c)) / (2.0 * e);
    PhysicalState up = state, down = state;
    up.q[i][axis] += 1e-5;
    down.q[i][axis] -= 1e-5;
    const double slope = (kinetic(tree, up) - kinetic(tree, down)) / 2e-5;
    const double torque =
        -tree[i].stiffness * state.q[i][axis] - tree[i].damping * state.rate[i][axis];
    EXPECT_NEAR(change - slope, torque, 1e-7 * scale) << c;
  }
}

// A force on a branch does the work that its path says: loads enter with their lever arms (E11).
TEST(PhysicalTree, LoadsDoTheirWork) {
  const std::vector<PhysicalBranch> tree = shrub(0.0);
  const PhysicalState state = randomState(tree.size(), 0.5, 2.0, 6);
  std::vector<Wrench> loads(tree.size());
  loads.back().force = Vec3(3.0, -5.0, 2.0);
  loads[2].torque = Vec3(0.0, 4.0, 1.0);
  const auto a = articulatedAccelerations(tree, state, loads);
  const double e = 1e-7;
  PhysicalState later = state, earlier = state;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    later.q[i] += e * state.rate[i];
    later.rate[i] += e * a[i];
    earlier.q[i] -= e * state.rate[i];
    earlier.rate[i] -= e * a[i];
  }
  const double power = (energyOf(tree, later) - energyOf(tree, earlier)) / (2.0 * e);
  const Kinematics k = kinematicsOf(tree, state);
  const double expected =
      dot(loads.back().force, k.velocity.back()) + dot(loads[2].torque, k.spin[2]);
  EXPECT_NEAR(power, expected, 1e-4 * std::fabs(expected));
}

TEST(PhysicalTree, RestIsAnEquilibrium) {
  const std::vector<PhysicalBranch> tree = shrub(0.1);
  for (const Eigen::Vector2d& a :
       articulatedAccelerations(tree, atRest(tree.size()), std::vector<Wrench>(tree.size())))
    EXPECT_EQ(a.norm(), 0.0);
}

double staticTip(int n, double force) {
  std::vector<PhysicalBranch> tree = beam(n, 2.0, 0.02, 8e9, 900.0);
  // A static load is found by letting a heavily damped beam settle in large implicit steps.
  for (PhysicalBranch& b : tree) b.damping = 0.05 * b.stiffness;
  PhysicalState state = atRest(tree.size());
  TreeStepper stepper(Integrator::IMPLICIT_EULER);
  const LoadFunction pull = [&](const Kinematics& k, double, std::vector<Wrench>& loads) {
    loads.back().force = Vec3(force, 0, 0);
    loads.back().torque =
        (tree.back().length * axisZ(k.pose.back().orientation)).cross(loads.back().force);
  };
  for (int i = 0; i < 400; ++i) stepper.step(tree, pull, 0.0, 0.05, state);
  const Kinematics k = kinematicsOf(tree, state);
  return (k.pose.back().position + tree.back().length * axisZ(k.pose.back().orientation)).x();
}

// S1-W2, E13: deflection of a cantilever against beam theory, F L^3 / (3 E I); the error falls with
// the square of the number of pieces.
TEST(PhysicalTree, CantileverBendsAsABeam) {
  const double inertia = M_PI * std::pow(0.02, 4) / 4.0, force = 1.0;
  const double theory = force * 8.0 / (3.0 * 8e9 * inertia);
  const double coarse = std::fabs(staticTip(8, force) / theory - 1.0);
  const double fine = std::fabs(staticTip(16, force) / theory - 1.0);
  EXPECT_LT(fine, 0.003);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

double firstFrequency(int n) {
  const std::vector<PhysicalBranch> tree = beam(n, 2.0, 0.02, 8e9, 900.0);
  const auto energy = [&](int i, int j) {
    PhysicalState state = atRest(tree.size());
    state.rate[static_cast<std::size_t>(i)].x() += 1.0;
    state.rate[static_cast<std::size_t>(j)].x() += 1.0;
    return kinetic(tree, state);
  };
  Eigen::MatrixXd mass(n, n), stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    stiffness(i, i) = tree[static_cast<std::size_t>(i)].stiffness;
    for (int j = 0; j < n; ++j)
      mass(i, j) = energy(i, j) - 0.25 * energy(i, i) - 0.25 * energy(j, j);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  return std::sqrt(solver.eigenvalues()(0));
}

// First frequency of a cantilever, 3.516 sqrt(E I / (rho A)) / L^2 [rad/s]: second order too.
TEST(PhysicalTree, CantileverSwingsAsABeam) {
  const double theory = 3.51602 * std::sqrt(8e9 * 0.02 * 0.02 / (4.0 * 900.0)) / 4.0;
  const double coarse = std::fabs(firstFrequency(8) / theory - 1.0);
  const double fine = std::fabs(firstFrequency(16) / theory - 1.0);
  EXPECT_LT(fine, 0.005);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

}  // namespace
}  // namespace vegetation_sim::forest
