// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/ribbon_ends.h"

#include <algorithm>

namespace vegetation_sim::view {
namespace {

constexpr double FOOT_DEPTH = 0.06;   // [m] of a foot below its root
constexpr double LONGEST_FOOT = 0.5;  // relative to the piece that it extends
// Widths at the root and at the tip of the last piece, relative to those that have no point.
constexpr float BEFORE_TIP = 0.85f, AT_TIP = 0.06f;

void extendFoot(canopy::Leaf& leaf) {
  const Vec3 way = leaf.tip - leaf.root;
  const double size = length(way);
  if (size > 0.0) leaf.root -= std::min(FOOT_DEPTH / size, LONGEST_FOOT) * way;
}

}  // namespace

void finishRibbons(bool whole, std::vector<canopy::Leaf>& leaves) {
  bool begins = true;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    canopy::Leaf& leaf = leaves[i];
    const bool ends = i + 1 == leaves.size() || leaves[i + 1].root != leaf.tip;
    if (begins && !leaf.lies) extendFoot(leaf);
    if (ends && whole) leaf.tip_width *= AT_TIP;
    if (ends && whole && !begins) {
      leaf.root_width *= BEFORE_TIP;
      leaves[i - 1].tip_width = leaf.root_width;
    }
    begins = ends;
  }
}

}  // namespace vegetation_sim::view
