// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sensors/geometry/box.h"

namespace vegetation_sim::scan {

/// Box in single precision, relative to the origin of its tree [m]; empty at first.
struct FloatBox {
  static constexpr float ENDLESS = std::numeric_limits<float>::infinity();
  float low[3]{ENDLESS, ENDLESS, ENDLESS}, high[3]{-ENDLESS, -ENDLESS, -ENDLESS};

  void add(const FloatBox& other);
};

/// Returns a box that contains `box`, which is relative to the tree's origin, with more room than
/// the rounding of its faces takes.
FloatBox enclose(const Box& box);

/// Returns the largest sum of the coordinates' magnitudes of a place in the box [m].
double extentOf(const Box& box);

/// Eight boxes and what is in each.
struct alignas(64) WideNode {
  static constexpr int WIDTH = 8;
  static constexpr std::int32_t EMPTY = std::numeric_limits<std::int32_t>::min();
  float planes[6][WIDTH];     ///< low x, y, z, high x, y, z; infinite and inverted if empty
  std::int32_t child[WIDTH];  ///< index of a node, ~index of a group of items, or EMPTY

  WideNode();
  void set(int slot, const FloatBox& box);
  FloatBox box() const;
};

/// Bounding volume hierarchy with eight children per node (Wald, Benthin and Boulos 2008). Its
/// leaves are groups of items. build() chooses the order with the surface area heuristic (Goldsmith
/// and Salmon 1987) in bins (Wald 2007); fit() moves the boxes in linear time.
class WideTree {
 public:
  /// @param group largest number of items of a group.
  explicit WideTree(int group) : group_(group) {}

  void build(const std::vector<Box>& items);
  /// Sets the boxes of all groups, which are relative to `origin`. [groups()]
  /// @param origin place near the items [m]; those that are nearer have smaller errors of rounding.
  void fit(const std::vector<Box>& groups, const Vec3& origin);

  int groups() const { return static_cast<int>(starts_.size()) - 1; }
  /// Returns the number of items of a group, which are item(group, 0) and so on.
  int size(int group) const { return starts_[at(group) + 1] - starts_[at(group)]; }
  int item(int group, int i) const { return order_[at(starts_[at(group)] + i)]; }
  const std::vector<WideNode>& nodes() const { return nodes_; }
  const Vec3& origin() const { return origin_; }
  /// Returns the largest sum of the coordinates' magnitudes of an item, relative to origin() [m].
  double extent() const { return extent_; }
  /// Returns the box of all items.
  const Box& bounds() const { return bounds_; }

  /// Largest number of children that wait while a ray is led through a tree of trees.
  static constexpr int MOST_WAITING = 1024;

 private:
  struct Range {
    int first{0}, count{0}, depth{0};
    double area{0.0};  ///< surface of the box of the items
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Range rangeOf(int first, int count, int depth) const;
  int buildNode(const Range& range);
  int split(const Range& range);
  int splitInMiddle(const Range& range, int axis);

  int group_;
  std::vector<int> order_;      ///< items, those of a group together
  std::vector<int> starts_{0};  ///< of the groups in order_, and its end
  std::vector<WideNode> nodes_;
  std::vector<Box> boxes_;  ///< scratch of build()
  Vec3 origin_{Vec3::Zero()};
  double extent_{0.0};
  Box bounds_;
};

}  // namespace vegetation_sim::scan
