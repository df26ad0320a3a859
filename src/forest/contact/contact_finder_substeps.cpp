// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "forest/contact/contact_pair.h"

namespace vegetation_sim::forest {
namespace {

// Largest displacement of a branch relative to a near body in a substep [m]. Springs and other
// contacts turn branches away from the path that the initial velocity predicts.
constexpr double MAX_TRAVEL = 10e-3;
constexpr int MAX_SUBSTEPS = 4;

}  // namespace

int ContactFinder::countSubsteps(const ContactTree& tree, const Bodies& bodies, Nanoseconds from,
                                 Nanoseconds to) const {
  const double h = secondsBetween(from, to);
  double way = 0.0;
  const LinkBounds bounds(tree);
  for (const auto& entry : bodies) {
    const Placed placed(entry.second, tree.foot, from);
    if (bounds.isFar(placed, h)) continue;
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
      const Pair pair(tree, i, placed);
      if (leastGap(placed, pair.bar) > pair.reach(h)) continue;
      if (nearest(placed.shape, placed.local(pair.bar)).gap > pair.reach(h)) continue;
      way = std::max(way, h * pair.fastest());
    }
  }
  return std::clamp(static_cast<int>(std::ceil(std::min(way, 1.0) / MAX_TRAVEL)), 1, MAX_SUBSTEPS);
}

}  // namespace vegetation_sim::forest
