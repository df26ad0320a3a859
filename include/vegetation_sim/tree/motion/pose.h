// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/tree/growth/response.h"
#include "vegetation_sim/tree/growth/skeleton.h"
#include "vegetation_sim/tree/motion/motion_level.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::forest {

/// A grown tree with its responses, from which its pose at any time is computed.
struct Tree {
  TreeSeed seed;
  Skeleton skeleton;
  std::vector<Response> response;  ///< per branch
  JointModel joint_model{JointModel::SWING};
  Drag drag{Drag::LINEAR};
  double reference_speed{8.0};  ///< for quadratic drag [m/s]
  Vec3 foot{Vec3::Zero()};      ///< world [m]
};

/// Grows a tree of a layout without what has come off it. A pure function: the same arguments give
/// the same bits. @throws InvalidInput for broken branches that the tree does not have.
Tree growTree(const Layout& layout, std::uint32_t id, const terrain::HeightMap& terrain,
              const BrokenBranches& broken = {});
/// Grows a tree with its foot at a place, by the motion law of its layout.
Tree growTree(const TreeSeed& seed, const Species& species, const MotionLaw& law, const Vec3& foot,
              const BrokenBranches& broken);
/// Grows a tree at the origin, with linear drag.
Tree growTree(const TreeSeed& seed, const Species& species, const MotionLaw& law,
              const BrokenBranches& broken = {});

/// Returns the deviation of each joint (equations 1 and 2), independent of all other branches and
/// of earlier steps (S1-19). `wind` is relative to the foot.
std::vector<JointAngles> proceduralAngles(const Tree& tree, const wind::Instant& wind,
                                          const Weights& weights);

/// Returns the pose of every branch in the tree's frame (origin at the foot, axes as the world's).
/// The scalar version in double precision, reference of BatchPoser.
std::vector<Pose> poseBranches(const Tree& tree, const wind::Instant& wind, const Weights& weights);

/// Returns the deviation of one of the joints.
JointAngles proceduralAngles(const Tree& tree, const wind::Instant& wind, const Weights& weights,
                             int branch);

/// Returns the pose of a branch on that of its parent, which the trunk ignores.
Pose poseOnParent(const Tree& tree, int branch, const JointAngles& angles, const Pose& parent);

/// Returns the poses for given joint deviations.
std::vector<Pose> forwardKinematics(const Tree& tree, const std::vector<JointAngles>& angles);

}  // namespace vegetation_sim::forest
