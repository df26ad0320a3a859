// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "sensors/geometry/box.h"
#include "sensors/geometry/ray.h"

namespace vegetation_sim::scan {

/// Returns the distance at which a ray enters a box: 0 from inside, infinite if it misses the box.
inline double entryOf(const Ray& ray, const Box& box) {
  double from = 0.0, to = Box::ENDLESS;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low[i] - ray.origin[i]) * ray.inverse[i];
    const double b = (box.high[i] - ray.origin[i]) * ray.inverse[i];
    // A ray in the plane of a face gives NaN there, which both comparisons ignore.
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to ? from : Box::ENDLESS;
}

/// Binary hierarchy of boxes in double precision with a plain traversal: the slow counterpart of
/// WideTree. Its order is chosen once; its boxes are refitted in linear time.
class BoxTree {
 public:
  /// Chooses the order by halving along the longest side.
  void build(const std::vector<Box>& items);
  /// Updates the boxes. Requires as many items as built.
  void refit(const std::vector<Box>& items);
  /// Returns the box of all items.
  Box bounds() const { return nodes_.empty() ? Box() : nodes_.front().box; }

  /// Calls meet(item), which may reduce `nearest`, for each item that a ray may hit; near ones
  /// first.
  template <class Meet>
  void visit(const Ray& ray, const Hit& nearest, Meet&& meet) const;

 private:
  static constexpr int FEW = 4;  // items of a leaf
  static constexpr int DEEPEST = 64;
  struct Node {
    Box box;
    int first{0}, count{0};  // of a leaf: its items in order_
    int right{0};            // of an inner node: its second half; the first half follows the node
  };
  struct Waiting {
    int node;
    double entry;
  };
  int buildNode(const std::vector<Box>& items, int first, int count);

  std::vector<int> order_;
  std::vector<Node> nodes_;
};

template <class Meet>
void BoxTree::visit(const Ray& ray, const Hit& nearest, Meet&& meet) const {
  if (nodes_.empty()) return;
  std::array<Waiting, DEEPEST> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, entryOf(ray, nodes_.front().box)};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (!(next.entry < nearest.distance)) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    for (int i = 0; i < node.count; ++i)
      meet(static_cast<std::size_t>(order_[static_cast<std::size_t>(node.first + i)]));
    if (node.count > 0) continue;
    Waiting near{next.node + 1, entryOf(ray, nodes_[static_cast<std::size_t>(next.node) + 1].box)};
    Waiting far{node.right, entryOf(ray, nodes_[static_cast<std::size_t>(node.right)].box)};
    if (far.entry < near.entry) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
}

}  // namespace vegetation_sim::scan
