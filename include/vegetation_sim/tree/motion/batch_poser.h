// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/dynamics/modes/batch_modes.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

/// Poses of many branches as a structure of arrays, in the tree's frame. Entries from `count` on
/// are scratch.
struct BatchPoses {
  int count{0};                       ///< branches that hold a pose
  std::vector<float> x, y, z;         ///< [branches] base [m]
  std::vector<float> qw, qx, qy, qz;  ///< [branches] orientation
  /// Scratch of the poser: once more the poses of branches that bear limbs, each in a row.
  std::vector<float> frames;

  Pose at(int branch) const;
};

/// Converts poses to single precision. Reuses the memory of `out`.
void narrowPoses(const std::vector<Pose>& poses, BatchPoses& out);

/// Branches begin to end, of one depth. first_parent is the parent of `begin` if all parents are
/// consecutive, else -1. bears_depth is the least depth of groups of the latter kind whose parents
/// are here.
struct BatchGroup {
  int begin{0}, end{0}, depth{0}, first_parent{-1};
  int bears_depth{MAX_DEPTHS};
};

/// Rest data of one tree as a structure of arrays in single precision, padded to the widest vector.
struct BatchTree {
  std::vector<std::int32_t> parent;  ///< of groups without first_parent; of the others 0
  std::vector<float> h;              ///< along the parent [m]
  std::vector<float> x, y, z;        ///< base at rest [m]
  /// RotationSeries: rest rotation in the parent (w x y z). Paper: cos, sin of theta / 2, of phi
  /// / 2.
  std::vector<float> r0, r1, r2, r3;
  std::vector<float> ax, ay, az, bx, by, bz;  ///< Response::first, second [rad s/m]
  std::vector<BatchGroup> groups;
  JointModel joint_model{JointModel::SWING};
  Drag drag{Drag::LINEAR};
  float reference_speed{8.f};
  double reach{0.0};       ///< farthest branch from the trunk's foot, horizontally [m]
  std::size_t bearers{0};  ///< one past the last branch of a group that bears
};

using physics::BatchBends;

/// Forward kinematics of one tree in single precision, many branches of one group at a time, in the
/// widest instruction set of the processor. The bits are the same in all of them: only + - * /
/// sqrt, no fused operations. Within 1e-5 of the tree's height of poseBranches.
class BatchPoser {
 public:
  explicit BatchPoser(const Tree& tree);

  /// Poses the branches of the first `depths` recursion depths; their parents carry branches
  /// without weight at rest. `wind` is relative to the tree's foot. Reuses the memory of `out`.
  void pose(const wind::Instant& wind, const Weights& weights, int depths, BatchPoses& out) const;

  /// Poses all branches for bends of all joints, limited as every joint (E16); `swing` only.
  void pose(const BatchBends& bends, BatchPoses& out) const;

  /// Bytes of permanent rest data per branch.
  static constexpr int BYTES_PER_BRANCH = 15 * 4;
  static constexpr int PADDING = 32;
  /// Floats of a row of BatchPoses::frames: x y z, qw qx qy qz, unused.
  static constexpr int FRAME = 8;

 private:
  void ready(BatchPoses& out) const;

  BatchTree tree_;
};

using vegetation_sim::chosenInstructionSet;
using vegetation_sim::forceInstructionSet;
using vegetation_sim::instructionSets;

}  // namespace vegetation_sim::forest
