// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "sensors/geometry/ray.h"

namespace vegetation_sim::scan {

/// Axis-aligned box [m]; empty at first.
struct Box {
  static constexpr double ENDLESS = std::numeric_limits<double>::infinity();
  Vec3 low{Vec3::Constant(ENDLESS)}, high{Vec3::Constant(-ENDLESS)};

  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  /// Adds a ball.
  void add(const Vec3& centre, double radius) {
    low = low.cwiseMin(Vec3(centre.array() - radius));
    high = high.cwiseMax(Vec3(centre.array() + radius));
  }
  /// Returns the distance at which a ray enters: 0 from inside, infinite if it misses the box.
  double entry(const Ray& ray) const {
    double from = 0.0, to = ENDLESS;
    for (int i = 0; i < 3; ++i) {
      const double a = (low[i] - ray.origin[i]) * ray.inverse[i];
      const double b = (high[i] - ray.origin[i]) * ray.inverse[i];
      // A ray in the plane of a face gives NaN there, which both comparisons ignore.
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return from <= to ? from : ENDLESS;
  }
};

/// Bounding volume hierarchy of items that move little. Its order is chosen once; its boxes are
/// refitted in linear time.
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
  waiting[count++] = {0, nodes_.front().box.entry(ray)};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (!(next.entry < nearest.distance)) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    for (int i = 0; i < node.count; ++i)
      meet(static_cast<std::size_t>(order_[static_cast<std::size_t>(node.first + i)]));
    if (node.count > 0) continue;
    Waiting near{next.node + 1, nodes_[static_cast<std::size_t>(next.node) + 1].box.entry(ray)};
    Waiting far{node.right, nodes_[static_cast<std::size_t>(node.right)].box.entry(ray)};
    if (far.entry < near.entry) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
}

}  // namespace vegetation_sim::scan
