// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/strip_tree.h"

namespace vegetation_sim::scan {

void StripTree::build(const std::vector<Strip>& strips, const Vec3& origin) {
  std::vector<Box> items;
  items.reserve(strips.size());
  for (const Strip& strip : strips) items.push_back(boxOf(strip));
  tree_.build(items);
  boxes_.resize(static_cast<std::size_t>(tree_.groups()));
  fit(strips, origin);
}

void StripTree::fit(const std::vector<Strip>& strips, const Vec3& origin) {
  for (int group = 0; group < tree_.groups(); ++group) {
    Box& box = boxes_[static_cast<std::size_t>(group)] = Box();
    for (int i = 0; i < tree_.size(group); ++i)
      box.add(boxOf(strips[static_cast<std::size_t>(tree_.item(group, i))]));
    box.low -= origin;
    box.high -= origin;
  }
  tree_.fit(boxes_, origin);
}

}  // namespace vegetation_sim::scan
