// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/box_tree.h"

#include <algorithm>
#include <numeric>

namespace vegetation_sim::scan {

void BoxTree::build(const std::vector<Box>& items) {
  order_.resize(items.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  if (items.empty()) return;
  nodes_.reserve(items.size());
  buildNode(items, 0, static_cast<int>(items.size()));
  refit(items);
}

// Nodes are in depth-first order, so that a node precedes its children.
int BoxTree::buildNode(const std::vector<Box>& items, int first, int count) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  if (count <= FEW) {
    nodes_.back().first = first;
    nodes_.back().count = count;
    return index;
  }
  const auto middle_of = [&](int item) {
    const Box& box = items[static_cast<std::size_t>(item)];
    return Vec3(0.5 * (box.low + box.high));
  };
  Box middles;
  for (int i = first; i < first + count; ++i)
    middles.add(middle_of(order_[static_cast<std::size_t>(i)]), 0.0);
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const int half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](int a, int b) {
    const double at_a = middle_of(a)[axis], at_b = middle_of(b)[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  buildNode(items, first, half);
  const int right = buildNode(items, first + half, count - half);
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

void BoxTree::refit(const std::vector<Box>& items) {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = Box();
    for (int k = node.first; k < node.first + node.count; ++k)
      node.box.add(items[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    if (node.count > 0) continue;
    node.box.add(nodes_[i + 1].box);
    node.box.add(nodes_[static_cast<std::size_t>(node.right)].box);
  }
}

}  // namespace vegetation_sim::scan
