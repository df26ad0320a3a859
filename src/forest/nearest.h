// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "forest/pick.h"
#include "tree/physical/interaction.h"

namespace vegetation_sim::forest {

/// The point of a forest's branches that is nearest to a given point.
struct Nearest {
  BranchPoint at;
  Vec3 point{Vec3::Zero()};  ///< on the axis of the branch, world [m]
  double distance{0.0};      ///< from the branch's surface, 0 inside it [m]
};

/// Searches all branches whose surface is within `reach` of a world point. `posed` grows and poses
/// a tree.
std::optional<Nearest> nearestBranch(const Layout& layout, const terrain::HeightMap& terrain,
                                     const Vec3& point, double reach,
                                     const std::function<PosedTree(std::uint32_t)>& posed);

}  // namespace vegetation_sim::forest
