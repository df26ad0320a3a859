// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/forest/interaction.h"

namespace vegetation_sim::physics {
struct Kinematics;
struct Loads;
}  // namespace vegetation_sim::physics

namespace vegetation_sim::forest {

class Forest;
class PhysicalPart;

using Bodies = std::map<std::string, Body>;
/// Branches by tree.
using BranchesOfTrees = std::map<std::uint32_t, std::vector<int>>;

/// How bodies touch trees. Without memory: what it needs between steps stands in bodies and parts.
class ContactModel {
 public:
  virtual ~ContactModel() = default;

  /// Adds the branches that bodies may touch until `to`: they are made physical at `from`, before
  /// they are touched, and stay so while they are named. Called once a tick, before its steps.
  virtual void findNear(const Forest& forest, const Bodies& bodies, Nanoseconds from,
                        Nanoseconds to, BranchesOfTrees& near) const = 0;

  /// Adds what the bodies do to one tree's physical links during the step [from, to]. `kinematics`
  /// and `loads` are per link, in the tree's frame (foot at the origin, axes as the world's).
  /// `reactions`: one per contact; those of a tick's last step are kept.
  virtual void addLoads(const PhysicalPart& part, const Bodies& bodies, Nanoseconds from,
                        Nanoseconds to, const physics::Kinematics& kinematics,
                        physics::Loads& loads, std::vector<Reaction>& reactions) const = 0;
};

}  // namespace vegetation_sim::forest
