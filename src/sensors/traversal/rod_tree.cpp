// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/rod_tree.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::scan {
namespace {

// Returns the distance from the axis within which meet() and within() may find a hit. Their
// formulas take the axis for a unit vector; a deviation of its square by e moves a surface as if
// the square of the radius were larger by e y^2, y being the place along the axis.
double reachOf(const RoomyRod& item) {
  const Rod& rod = item.rod;
  const double deviation = std::fabs(dot(rod.axis, rod.axis) - 1.0);
  const double slope = rod.length > 0.0 ? (rod.tip_radius - rod.base_radius) / rod.length : 0.0;
  const double widest = std::max({item.room, rod.base_radius, rod.tip_radius});
  return std::sqrt(widest * widest +
                   2.0 * deviation * (1.0 + slope * slope) * rod.length * rod.length);
}

}  // namespace

Box RodTree::boxAround(const RoomyRod& item) {
  Box out;
  const double reach = reachOf(item);
  out.add(item.rod.base, reach);
  out.add(item.rod.base + item.rod.length * item.rod.axis, reach);
  return out;
}

void RodTree::build(const std::vector<Box>& items) {
  tree_.build(items);
  groups_.resize(static_cast<std::size_t>(tree_.groups()));
  boxes_.resize(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    RodGroup& group = groups_[g];
    group.count = tree_.size(static_cast<int>(g));
    for (int i = 0; i < group.count; ++i)
      group.rods[i] = static_cast<std::uint32_t>(tree_.item(static_cast<int>(g), i));
  }
}

void RodTree::put(const RoomyRod& item, const Vec3& origin, int lane, std::size_t group) {
  RodGroup& out = groups_[group];
  const double reach = reachOf(item);
  const Vec3 base = item.rod.base - origin, way = item.rod.length * item.rod.axis;
  for (int k = 0; k < 3; ++k) {
    out.base[k][lane] = static_cast<float>(base[k]);
    out.way[k][lane] = static_cast<float>(way[k]);
  }
  const auto widen = [](double radius) { return radius * (1.0 + 1e-6) + 1e-6; };
  out.radius[lane] = roundUp(static_cast<float>(widen(reach)));
  const double bare = widen(reachOf({item.rod, 0.0})) / widen(reach);
  out.bare[lane] = static_cast<std::uint8_t>(std::ceil(BARE_PARTS * bare) + 1.0);
  boxes_[group].add(base, reach);
  boxes_[group].add(base + way, reach);
}

}  // namespace vegetation_sim::scan
