// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tree/growth/tree_grid.h"
#include "tree/physical/interaction.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

/// A tool that cuts branches: a plate in the x-y plane of its pose, on a straight way.
struct Knife {
  static constexpr double THICKNESS = 0.02;  ///< of the plate [m]

  bool is_disc{false};
  double length{0.3}, width{0.5};  ///< along x and y; `width` is the diameter of a disc [m]
  double thickest{0.02};           ///< radius of a branch that it cuts [m]
  Pose from, to;                   ///< of the middle, world
};

/// Returns the branches that a knife cuts on its way: those of which a part that is thin enough
/// meets the plate. `poses` are in the tree's frame. A branch that another one carries off is not
/// among them, nor are the foot of the trunk and what has come off. Rising.
std::vector<int> findCuts(const Tree& tree, const std::vector<Pose>& poses,
                          const std::vector<Knife>& knives);

/// How trees are grown and posed.
struct TreePoser {
  std::function<std::shared_ptr<const Tree>(std::uint32_t tree)> grow;
  std::function<std::vector<Pose>(const Tree& tree, std::uint32_t id)> pose;
};

/// Does the same for all trees around the knives; sorted by tree, then by branch.
std::vector<BranchCut> findCuts(const Layout& layout, const TreeGrid& grid,
                                const terrain::HeightMap& terrain, const std::vector<Knife>& knives,
                                const TreePoser& trees);

}  // namespace vegetation_sim::forest
