// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

Tree growTree(const TreeSeed& seed, const Species& species, const MotionLaw& law,
              const BrokenBranches& broken) {
  Tree out;
  out.seed = seed;
  out.skeleton = grow(seed, species);
  breakOff(broken, out.skeleton);
  out.response = windResponse(out.skeleton, species, law);
  out.joint_model = law.joint_model;
  return out;
}

Tree growTree(const Layout& layout, std::uint32_t id, const terrain::HeightMap& terrain,
              const BrokenBranches& broken) {
  const TreeSeed seed = seedOf(layout, id);
  return growTree(seed, layout.species.at(seed.species), layout.motion, footOf(seed, terrain),
                  broken);
}

Tree growTree(const TreeSeed& seed, const Species& species, const MotionLaw& law, const Vec3& foot,
              const BrokenBranches& broken) {
  Tree out = growTree(seed, species, law, broken);
  out.drag = law.drag;
  out.reference_speed = species.reference_speed;
  out.foot = foot;
  return out;
}

JointAngles proceduralAngles(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                             int branch) {
  const auto i = static_cast<std::size_t>(branch);
  const Branch& b = tree.skeleton.branches[i];
  const double weight = weights[static_cast<std::size_t>(b.depth)];
  if (weight <= 0.0) return {};
  const Vec3 velocity =
      effectiveVelocity(wind.velocity(b.rest.position), tree.drag, tree.reference_speed);
  return deviation(tree.response[i], velocity, weight, tree.joint_model);
}

std::vector<JointAngles> proceduralAngles(const Tree& tree, const wind::Instant& wind,
                                          const Weights& weights) {
  std::vector<JointAngles> out(tree.skeleton.branches.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = proceduralAngles(tree, wind, weights, static_cast<int>(i));
  return out;
}

Pose poseOnParent(const Tree& tree, int branch, const JointAngles& angles, const Pose& parent) {
  const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(branch)];
  const Quat local = jointRotation(b, angles, tree.joint_model);
  Pose out;
  if (b.parent < 0) {
    out.orientation = local;
    return out;
  }
  out.orientation = parent.orientation * local;
  out.position = parent.position + b.h * axisZ(parent.orientation);
  return out;
}

std::vector<Pose> forwardKinematics(const Tree& tree, const std::vector<JointAngles>& angles) {
  std::vector<Pose> out(angles.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int parent = tree.skeleton.branches[i].parent;
    out[i] = poseOnParent(tree, static_cast<int>(i), angles[i],
                          parent < 0 ? Pose() : out[static_cast<std::size_t>(parent)]);
  }
  return out;
}

std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind,
                               const Weights& weights) {
  return forwardKinematics(tree, proceduralAngles(tree, wind, weights));
}

}  // namespace vegetation_sim::forest
