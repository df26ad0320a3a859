// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/articulated.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "scenes/dynamics/chain_fixture.h"

namespace vegetation_sim::physics {
namespace {

std::vector<Vec2> accelerationsOf(const std::vector<Link>& links, const ChainState& state,
                                  const Loads& loads, const std::vector<BaseMotion>& bases = {}) {
  ArticulatedBody body;
  std::vector<Vec2> out;
  body.accelerations(links, bases, state, kinematicsAt(links, state, bases), loads, {}, out);
  return out;
}

Loads noLoads(std::size_t links) {
  Loads out;
  out.clear(links);
  return out;
}

/// Links whose bodies lie off their axes, as those of several pieces of wood do.
std::vector<Link> lopsided(std::size_t count) {
  std::vector<Link> out = crown(count, 0.1);
  const Random random(3);
  for (std::size_t i = 0; i < count; ++i) {
    Link& link = out[i];
    const Vec3 d(random.uniform(3 * i, -0.2, 0.2), random.uniform(3 * i + 1, -0.2, 0.2),
                 random.uniform(3 * i + 2, 0.0, 0.4));
    const double m = 0.5 * link.mass;  // a point of wood at d
    link.centre = (link.mass * link.centre + m * d) / (link.mass + m);
    link.mass += m;
    link.inertia.xx += m * (d.y() * d.y() + d.z() * d.z());
    link.inertia.yy += m * (d.x() * d.x() + d.z() * d.z());
    link.inertia.zz += m * (d.x() * d.x() + d.y() * d.y());
    link.inertia.xy -= m * d.x() * d.y();
    link.inertia.xz -= m * d.x() * d.z();
    link.inertia.yz -= m * d.y() * d.z();
  }
  return out;
}

double kinetic(std::vector<Link> links, const ChainState& state) {
  for (Link& link : links) link.stiffness = 0.0;
  return energyOf(links, state, kinematicsAt(links, state));
}

/// Generalised momentum dT/d(rate) of coordinate c; it is exact, because T is quadratic in the
/// rates.
double momentum(const std::vector<Link>& links, ChainState state, std::size_t c) {
  double& rate = state.rate[c / 2][static_cast<int>(c % 2)];
  const double here = rate;
  rate = here + 0.5;
  const double up = kinetic(links, state);
  rate = here - 0.5;
  return up - kinetic(links, state);
}

/// Returns the state a little later or earlier under constant acceleration.
ChainState moved(const ChainState& state, const std::vector<Vec2>& a, double dt) {
  ChainState out = state;
  for (std::size_t i = 0; i < a.size(); ++i) {
    out.q[i] += dt * state.rate[i] + 0.5 * dt * dt * a[i];
    out.rate[i] += dt * a[i];
  }
  return out;
}

// S1-30: the full chain's equations of motion against Lagrange's, from the kinetic energy alone:
// d/dt dT/d(rate) - dT/dq = spring + damper, at large angles and rates.
TEST(Articulated, ObeysLagrangesEquations) {
  const std::vector<Link> links = lopsided(15);
  const ChainState state = randomState(links.size(), 0.7, 3.0, 5);
  const auto a = accelerationsOf(links, state, noLoads(links.size()));
  const double e = 1e-6;  // [s] far below the period of the stiffest twig
  const ChainState later = moved(state, a, e), earlier = moved(state, a, -e);
  double scale = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i)
    scale = std::max(scale, links[i].stiffness * state.q[i].norm());
  for (std::size_t c = 0; c < 2 * links.size(); ++c) {
    const std::size_t i = c / 2;
    const int axis = static_cast<int>(c % 2);
    const double change = (momentum(links, later, c) - momentum(links, earlier, c)) / (2.0 * e);
    ChainState up = state, down = state;
    up.q[i][axis] += 1e-5;
    down.q[i][axis] -= 1e-5;
    const double slope = (kinetic(links, up) - kinetic(links, down)) / 2e-5;
    const double torque =
        -links[i].stiffness * state.q[i][axis] - links[i].damping * state.rate[i][axis];
    EXPECT_NEAR(change - slope, torque, 1e-6 * scale) << c;
  }
}

// S1-27, E17: a force does the work that its path says: loads enter with their lever arms.
TEST(Articulated, LoadsDoTheirWork) {
  const std::vector<Link> links = crown(31, 0.0);
  const ChainState state = randomState(links.size(), 0.5, 2.0, 6);
  Loads loads = noLoads(links.size());
  loads.wrench.back().force = Vec3(3.0, -5.0, 2.0);
  loads.wrench[2].torque = Vec3(0.0, 4.0, 1.0);
  loads.joint_torque[5] = Vec2(1.0, -2.0);
  const Kinematics k = kinematicsAt(links, state);
  Anchor anchor;
  anchor.link = 9;
  anchor.arm = Vec3(0.1, 0.2, 0.05);
  anchor.force = Vec3(-2.0, 1.0, 4.0);
  loads.anchors = {anchor};
  const auto a = accelerationsOf(links, state, loads);
  const double e = 1e-7;
  const auto energy = [&](double dt) {
    const ChainState s = moved(state, a, dt);
    return energyOf(links, s, kinematicsAt(links, s));
  };
  const double power = (energy(e) - energy(-e)) / (2.0 * e);
  const Vec3 held = k.velocity[9] + cross(k.spin[9], anchor.arm);
  const double expected = dot(loads.wrench.back().force, k.velocity.back()) +
                          dot(loads.wrench[2].torque, k.spin[2]) +
                          loads.joint_torque[5].dot(state.rate[5]) + dot(anchor.force, held);
  EXPECT_NEAR(power, expected, 1e-4 * std::fabs(expected));
}

// S1-31, E2: inner torques and forces cancel: only the force of the ground changes the momentum of
// the whole tree. Without ground (with a heavy block in its place) momentum is conserved.
TEST(Articulated, MomentumIsBalanced) {
  const std::vector<Link> links = lopsided(15);
  const ChainState state = randomState(links.size(), 0.6, 2.0, 7);
  Loads loads = noLoads(links.size());
  loads.wrench[7].force = Vec3(1.0, 2.0, 3.0);
  const auto a = accelerationsOf(links, state, loads);
  const double e = 1e-6;
  const auto at = [&](double dt) {
    const ChainState s = moved(state, a, dt);
    return momentumOf(links, kinematicsAt(links, s)).angular;
  };
  const Vec3 change = (at(e) - at(-e)) / (2.0 * e);
  // Only spring and damper of the root joint, along its axes, and the force act from outside.
  const Kinematics k = kinematicsAt(links, state);
  const Vec3 outside = cross(k.pose[7].position, loads.wrench[7].force);
  const double scale = change.norm() + outside.norm();
  const Vec3 ground = change - outside;
  for (int axis = 0; axis < 2; ++axis) {
    // Work of the ground's torque over a rate of the root's bend alone.
    ChainState probe = atRest(links.size());
    probe.q = state.q;
    probe.rate[0][axis] = 1.0;
    const Vec3 turning = kinematicsAt(links, probe).spin[0];
    const double spring =
        -links[0].stiffness * state.q[0][axis] - links[0].damping * state.rate[0][axis];
    EXPECT_NEAR(dot(ground, turning), spring, 1e-6 * scale) << axis;
  }
}

TEST(Articulated, InverseDynamicsUndoesForward) {
  const std::vector<Link> links = lopsided(31);
  const ChainState state = randomState(links.size(), 0.8, 3.0, 8);
  std::vector<BaseMotion> bases(1);
  bases[0].spin = Vec3(0.3, -0.2, 0.5);
  bases[0].velocity = Vec3(1.0, 0.0, -1.0);
  bases[0].spin_rate = Vec3(2.0, 1.0, -1.0);
  bases[0].acceleration = Vec3(-3.0, 2.0, 5.0);
  Loads loads = noLoads(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    loads.joint_torque[i] = Vec2(0.1 * static_cast<double>(i), -0.3);
  loads.wrench[4].force = Vec3(3.0, 1.0, 0.0);
  const auto a = accelerationsOf(links, state, loads, bases);
  ArticulatedBody body;
  std::vector<Vec2> torque;
  body.torques(links, bases, state, kinematicsAt(links, state, bases), loads, a, torque);
  for (std::size_t i = 0; i < links.size(); ++i)
    EXPECT_LT((torque[i] - loads.joint_torque[i]).norm(), 1e-9 * (1.0 + links[i].stiffness)) << i;
}

// S1-35: a chain on a moving base has the motion of the same chain whose first link is driven so.
TEST(Articulated, MovingBaseIsAsADrivenLink) {
  const std::vector<Link> whole = lopsided(15);
  const ChainState state = randomState(whole.size(), 0.5, 2.0, 9);
  const auto a = accelerationsOf(whole, state, noLoads(whole.size()));
  // Links on link 0 become roots on a base that moves as link 0 does.
  const Kinematics k = kinematicsAt(whole, state);
  const double e = 1e-6;
  const Kinematics up = kinematicsAt(whole, moved(state, a, e));
  const Kinematics down = kinematicsAt(whole, moved(state, a, -e));
  BaseMotion base;
  base.pose = k.pose[0];
  base.spin = k.spin[0];
  base.velocity = k.velocity[0];
  base.spin_rate = (up.spin[0] - down.spin[0]) / (2.0 * e);
  base.acceleration = (up.velocity[0] - down.velocity[0]) / (2.0 * e);
  std::vector<Link> rest(whole.begin() + 1, whole.end());
  for (Link& link : rest) --link.parent;
  const ChainState tail{{state.q.begin() + 1, state.q.end()},
                        {state.rate.begin() + 1, state.rate.end()}};
  const auto b = accelerationsOf(rest, tail, noLoads(rest.size()), {base});
  for (std::size_t i = 0; i < rest.size(); ++i)
    EXPECT_LT((b[i] - a[i + 1]).norm(), 1e-6 * (1.0 + a[i + 1].norm())) << i;
}

// A tree that is rotated as a whole moves the same, rotated.
TEST(Articulated, RotationOfTheWorldChangesNothing) {
  const std::vector<Link> links = lopsided(15);
  const ChainState state = randomState(links.size(), 0.5, 2.0, 10);
  std::vector<BaseMotion> bases(1);
  bases[0].pose.orientation = {0.5, 0.5, -0.5, 0.5};
  Loads loads = noLoads(links.size()), turned = loads;
  loads.wrench[3].force = Vec3(1.0, -2.0, 0.5);
  turned.wrench[3].force = rotate(bases[0].pose.orientation, loads.wrench[3].force);
  const auto a = accelerationsOf(links, state, loads);
  const auto b = accelerationsOf(links, state, turned, bases);
  for (std::size_t i = 0; i < links.size(); ++i)
    EXPECT_LT((a[i] - b[i]).norm(), 1e-9 * (1.0 + a[i].norm())) << i;
}

TEST(Articulated, RestIsAnEquilibrium) {
  const std::vector<Link> links = crown(31, 0.1);
  for (const Vec2& a : accelerationsOf(links, atRest(31), noLoads(31))) EXPECT_EQ(a.norm(), 0.0);
}

double firstFrequency(int n) {
  const std::vector<Link> links = beam(n, 2.0, 0.02, 8e9, 900.0);
  const auto energy = [&](int i, int j) {
    ChainState state = atRest(links.size());
    state.rate[static_cast<std::size_t>(i)].x() += 1.0;
    state.rate[static_cast<std::size_t>(j)].x() += 1.0;
    return kinetic(links, state);
  };
  Eigen::MatrixXd mass(n, n), stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    stiffness(i, i) = links[static_cast<std::size_t>(i)].stiffness;
    for (int j = 0; j < n; ++j)
      mass(i, j) = energy(i, j) - 0.25 * energy(i, i) - 0.25 * energy(j, j);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  return std::sqrt(solver.eigenvalues()(0));
}

// E13: first frequency of a cantilever, 3.516 sqrt(E I / (rho A)) / L^2 [rad/s]; the error falls
// with the square of the number of pieces.
TEST(Articulated, CantileverOscillatesAsABeam) {
  const double theory = 3.51602 * std::sqrt(8e9 * 0.02 * 0.02 / (4.0 * 900.0)) / 4.0;
  const double coarse = std::fabs(firstFrequency(8) / theory - 1.0);
  const double fine = std::fabs(firstFrequency(16) / theory - 1.0);
  EXPECT_LT(fine, 0.005);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

}  // namespace
}  // namespace vegetation_sim::physics
