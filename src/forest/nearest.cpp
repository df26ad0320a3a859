// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/nearest.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

Nearest nearestOn(const Branch& branch, const Vec3& base, const Vec3& axis, const Vec3& point) {
  Nearest out;
  out.at.along = std::clamp(dot(point - base, axis), 0.0, branch.length);
  out.point = base + out.at.along * axis;
  const double f = out.at.along / branch.length;
  const double radius = branch.base_radius + (branch.tip_radius - branch.base_radius) * f;
  out.distance = std::max(0.0, length(point - out.point) - radius);
  return out;
}

}  // namespace

std::optional<Nearest> nearestBranch(const Layout& layout, const terrain::HeightMap& terrain,
                                     const Vec3& point, double reach,
                                     const std::function<PosedTree(std::uint32_t)>& posed) {
  std::optional<Nearest> best;
  for (const std::uint32_t id : findTreesNear(layout, terrain, point, reach)) {
    const PosedTree tree = posed(id);
    for (std::size_t i = 0; i < tree.poses.size(); ++i) {
      const Branch& branch = tree.tree->skeleton.branches[i];
      if (branch.broken) continue;
      Nearest here = nearestOn(branch, tree.tree->foot + tree.poses[i].position,
                               axisZ(tree.poses[i].orientation), point);
      if (here.distance > reach || (best && best->distance <= here.distance)) continue;
      here.at.tree = id;
      here.at.branch = static_cast<int>(i);
      best = here;
    }
  }
  return best;
}

}  // namespace vegetation_sim::forest
