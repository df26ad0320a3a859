// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/lod/bending.h"

#include <algorithm>

#include "vegetation_sim/tree/growth/response.h"

namespace vegetation_sim::forest {
namespace {

constexpr double BENDING_WIND = 0.5;  // [m/s] weak enough that no joint nears its limit
constexpr double BENT = 0.3;  // [rad] rotation at which bending is measured, well above rounding
constexpr int ROUNDS = 20;    // [iterations] leave a millionth of the error

wind::Instant steady(const Vec3& velocity) {
  wind::Instant out;
  out.mean = velocity;
  return out;
}

// Returns the largest accumulated rotation from the ground, per speed.
double turn(const TreeModels& tiers, const Vec3& along) {
  std::vector<double> bends;
  for (const JointAngles& bend : allDepths(tiers.tree, steady(BENDING_WIND * along)))
    bends.insert(bends.end(), {bend.first, bend.second});
  std::vector<physics::SmallMotion> motion;
  tiers.linear.motionOf(bends.data(), motion);
  double out = 0.0;
  for (const physics::SmallMotion& link : motion) out = std::max(out, length(link.turn));
  return out / BENDING_WIND;
}

// Returns the bends at which springs balance a steady wind, by damped iteration.
std::vector<JointAngles> balance(const TreeModels& tiers, const wind::Instant& air) {
  const std::size_t n = tiers.links.size();
  physics::ChainState state{std::vector<physics::Vec2>(n, physics::Vec2::Zero()), {}};
  state.rate = state.q;
  const std::vector<physics::Vec2> still = state.q;
  std::vector<physics::Vec2> missing;
  physics::Kinematics now;
  physics::Loads loads;
  for (int round = 0; round < ROUNDS; ++round) {
    physics::kinematicsOf(tiers.links, {}, state, now);
    loads.clear(n);
    for (std::size_t i = 0; i < n; ++i) {
      const physics::Grip& grip = tiers.grips[i];
      const Vec3 force = grip.steady * air.mean;
      loads.wrench[i] = {force, cross(rotate(now.pose[i].orientation, grip.centre), force)};
    }
    physics::ArticulatedBody().torques(tiers.links, {}, state, now, loads, still, missing);
    for (std::size_t i = 0; i < n; ++i) state.q[i] -= 0.5 / tiers.links[i].stiffness * missing[i];
  }
  std::vector<JointAngles> out;
  for (const physics::Vec2& q : state.q) out.push_back({q.x(), q.y()});
  return out;
}

// Does the same for a modal tree.
std::vector<JointAngles> balance(const ModalTree& tree, const wind::Instant& air) {
  ModalAir kept;
  const std::vector<double> still(tree.size(), 0.0);
  std::vector<double> rest, force, amplitude = still;
  tree.loadOf(air, kept, rest);
  for (int round = 0; round < ROUNDS; ++round) {
    force = rest;
    tree.bendLevers(tree.leverAir(tree.airOn(air), still), amplitude, kept, force);
    for (std::size_t m = 0; m < tree.size(); ++m) {
      const double w = tree.modes().frequency[m];
      amplitude[m] += 0.5 * (force[m] / (w * w) - amplitude[m]);
    }
  }
  return tree.bendsOf(amplitude);
}

}  // namespace

std::vector<JointAngles> allDepths(const Tree& tree, const wind::Instant& air) {
  Weights all;
  all.fill(1.0);
  return proceduralAngles(tree, air, all);
}

Bending bendingOf(const TreeModels& tiers, const Vec3& along) {
  const double speed = BENT / turn(tiers, along);
  const wind::Instant air = steady(speed * along);
  const std::vector<Pose> right = forwardKinematics(tiers.tree, balance(tiers, air));
  const auto off = [&](const std::vector<JointAngles>& bends) {
    const std::vector<Pose> shown = forwardKinematics(tiers.tree, bends);
    double most = 0.0;
    for (std::size_t i = 0; i < right.size(); ++i) {
      const Branch& branch = tiers.tree.skeleton.branches[i];
      most = std::max(most, length(tipOf(branch, right[i]) - tipOf(branch, shown[i])));
    }
    return most / (speed * speed);
  };
  return {off(allDepths(tiers.tree, air)), off(balance(tiers.modal, air))};
}

}  // namespace vegetation_sim::forest
