// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/rod_tree.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::scan {
namespace {

// Returns the distance from the axis within which meet() and within() may find a hit. Their
// formulas take the axis for a unit vector; a deviation of its square by e moves a surface as if
// the square of the radius were larger by e y^2, y being the place along the axis.
double reachOf(const Rod& rod, double radius) {
  const double deviation = std::fabs(dot(rod.axis, rod.axis) - 1.0);
  const double slope = rod.length > 0.0 ? (rod.tip_radius - rod.base_radius) / rod.length : 0.0;
  const double widest = std::max({radius, rod.base_radius, rod.tip_radius});
  return std::sqrt(widest * widest +
                   2.0 * deviation * (1.0 + slope * slope) * rod.length * rod.length);
}

}  // namespace

void RodTree::build(const std::vector<Rod>& rods, const std::vector<double>& radii,
                    const Vec3& origin) {
  std::vector<Box> items(rods.size());
  for (std::size_t i = 0; i < rods.size(); ++i) {
    items[i].add(rods[i].base, reachOf(rods[i], radii[i]));
    items[i].add(rods[i].base + rods[i].length * rods[i].axis, reachOf(rods[i], radii[i]));
  }
  tree_.build(items);
  groups_.resize(static_cast<std::size_t>(tree_.groups()));
  boxes_.resize(groups_.size());
  fit(rods, radii, origin);
}

void RodTree::fit(const std::vector<Rod>& rods, const std::vector<double>& radii,
                  const Vec3& origin) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    RodGroup& group = groups_[g];
    group.count = tree_.size(static_cast<int>(g));
    Box box;
    for (int i = 0; i < group.count; ++i) {
      const auto item = static_cast<std::size_t>(tree_.item(static_cast<int>(g), i));
      const Rod& rod = rods[item];
      const double reach = reachOf(rod, radii[item]);
      const Vec3 base = rod.base - origin, way = rod.length * rod.axis;
      for (int k = 0; k < 3; ++k) {
        group.base[k][i] = static_cast<float>(base[k]);
        group.way[k][i] = static_cast<float>(way[k]);
      }
      group.radius[i] = static_cast<float>(reach * (1.0 + 1e-6) + 1e-6);
      box.add(base, reach);
      box.add(base + way, reach);
    }
    boxes_[g] = box;
  }
  tree_.fit(boxes_, origin);
}

}  // namespace vegetation_sim::scan
