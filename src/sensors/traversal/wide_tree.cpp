// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/wide_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace vegetation_sim::scan {
namespace {

constexpr int BINS = 16;
// Below this depth ranges are halved. The depth is then at most 32 + 31, and each level of nodes
// leaves at most seven children waiting: in two trees fewer than MOST_WAITING.
constexpr int DEEPEST = 32;

Vec3 middleOf(const Box& box) {
  return 0.5 * (box.low + box.high);
}

double areaOf(const Box& box) {
  if (box.isEmpty()) return 0.0;
  const Vec3 size = box.high - box.low;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

// Items by the bin of their middle along an axis.
struct Bins {
  std::array<Box, BINS> boxes;
  std::array<int, BINS> counts{};

  void add(int bin, const Box& box) {
    boxes[static_cast<std::size_t>(bin)].add(box);
    ++counts[static_cast<std::size_t>(bin)];
  }
};

int binOf(double middle, double low, double per_bin) {
  return std::clamp(static_cast<int>((middle - low) * per_bin), 0, BINS - 1);
}

struct Cut {
  double cost{Box::ENDLESS};
  int axis{0}, bin{0};  // items of the bins below `bin` come first
};

// Keeps the cheapest cut between two bins. A group costs the same however many items it has.
void compareCuts(const Bins& bins, int axis, int group, Cut& best) {
  std::array<double, BINS> right{};
  Box box;
  int count = 0;
  for (std::size_t i = BINS - 1; i > 0; --i) {
    box.add(bins.boxes[i]);
    count += bins.counts[i];
    right[i] = areaOf(box) * ((count + group - 1) / group);
  }
  box = Box();
  count = 0;
  for (std::size_t i = 1; i < BINS; ++i) {
    box.add(bins.boxes[i - 1]);
    count += bins.counts[i - 1];
    const double cost = areaOf(box) * ((count + group - 1) / group) + right[i];
    if (cost < best.cost) best = {cost, axis, static_cast<int>(i)};
  }
}

}  // namespace

void FloatBox::add(const FloatBox& other) {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

double extentOf(const Box& box) {
  return box.isEmpty() ? 0.0 : box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).sum();
}

FloatBox enclose(const Box& box) {
  FloatBox out;
  if (box.isEmpty()) return out;
  const double room =
      1e-6 + 0x1p-21 * extentOf(box);  // a face is rounded by at most 2^-24 of its place
  for (int i = 0; i < 3; ++i) {
    out.low[i] = static_cast<float>(box.low[i] - room);
    out.high[i] = static_cast<float>(box.high[i] + room);
  }
  return out;
}

WideNode::WideNode() {
  for (int slot = 0; slot < WIDTH; ++slot) {
    set(slot, FloatBox());
    child[slot] = EMPTY;
  }
}

void WideNode::set(int slot, const FloatBox& box) {
  for (int i = 0; i < 3; ++i) {
    planes[i][slot] = box.low[i];
    planes[3 + i][slot] = box.high[i];
  }
}

FloatBox WideNode::box() const {
  FloatBox out;
  for (int i = 0; i < 3; ++i)
    for (int slot = 0; slot < WIDTH; ++slot) {
      out.low[i] = std::min(out.low[i], planes[i][slot]);
      out.high[i] = std::max(out.high[i], planes[3 + i][slot]);
    }
  return out;
}

void WideTree::build(const std::vector<Box>& items) {
  order_.resize(items.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  starts_.assign(1, 0);
  if (items.empty()) return;
  boxes_ = items;
  buildNode(rangeOf(0, static_cast<int>(items.size()), 0));
  boxes_ = {};
}

WideTree::Range WideTree::rangeOf(int first, int count, int depth) const {
  Box all;
  for (int i = first; i < first + count; ++i) all.add(boxes_[at(order_[at(i)])]);
  return {first, count, depth, areaOf(all)};
}

// A node precedes its children. The range with the largest surface is split first.
int WideTree::buildNode(const Range& range) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  std::vector<Range> parts{range};
  while (parts.size() < WideNode::WIDTH) {
    Range* largest = nullptr;
    for (Range& part : parts)
      if (part.count > group_ && (!largest || part.area > largest->area)) largest = &part;
    if (!largest) break;
    const Range whole = *largest;
    const int half = split(whole);
    *largest = rangeOf(whole.first, half, whole.depth + 1);
    parts.push_back(rangeOf(whole.first + half, whole.count - half, whole.depth + 1));
  }
  std::sort(parts.begin(), parts.end(),
            [](const Range& a, const Range& b) { return a.first < b.first; });
  for (std::size_t slot = 0; slot < parts.size(); ++slot) {
    std::int32_t child = 0;
    if (parts[slot].count <= group_) {
      child = ~groups();
      starts_.push_back(parts[slot].first + parts[slot].count);
    } else {
      child = buildNode(parts[slot]);
    }
    nodes_[at(index)].child[slot] = child;
  }
  return index;
}

// Reorders the items of a range. Returns how many are in its first part.
int WideTree::split(const Range& range) {
  Box middles;
  for (int i = range.first; i < range.first + range.count; ++i)
    middles.add(middleOf(boxes_[at(order_[at(i)])]), 0.0);
  const Vec3 size = middles.high - middles.low;
  int longest = 0;
  size.maxCoeff(&longest);
  if (range.depth >= DEEPEST || !(size[longest] > 0.0)) return splitInMiddle(range, longest);
  const Vec3 per_bin = (BINS * (1.0 - 1e-9)) * size.cwiseInverse();
  Cut best;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0.0)) continue;
    Bins bins;
    for (int i = range.first; i < range.first + range.count; ++i) {
      const Box& box = boxes_[at(order_[at(i)])];
      bins.add(binOf(middleOf(box)[axis], middles.low[axis], per_bin[axis]), box);
    }
    compareCuts(bins, axis, group_, best);
  }
  const auto begin = order_.begin() + range.first;
  const auto middle = std::stable_partition(begin, begin + range.count, [&](int item) {
    return binOf(middleOf(boxes_[at(item)])[best.axis], middles.low[best.axis],
                 per_bin[best.axis]) < best.bin;
  });
  const int half = static_cast<int>(middle - begin);
  return half > 0 && half < range.count ? half : splitInMiddle(range, longest);
}

int WideTree::splitInMiddle(const Range& range, int axis) {
  const int half = range.count / 2;
  const auto begin = order_.begin() + range.first;
  std::nth_element(begin, begin + half, begin + range.count, [&](int a, int b) {
    const double at_a = middleOf(boxes_[at(a)])[axis], at_b = middleOf(boxes_[at(b)])[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  return half;
}

void WideTree::fit(const std::vector<Box>& groups, const Vec3& origin) {
  Box all;
  for (const Box& group : groups) all.add(group);
  origin_ = origin;
  extent_ = extentOf(all);
  bounds_ = Box();
  if (!all.isEmpty()) bounds_ = {all.low + origin, all.high + origin};
  for (std::size_t i = nodes_.size(); i-- > 0;)
    for (int slot = 0; slot < WideNode::WIDTH; ++slot) {
      const std::int32_t child = nodes_[i].child[slot];
      if (child >= 0)
        nodes_[i].set(slot, nodes_[at(child)].box());
      else if (child != WideNode::EMPTY)
        nodes_[i].set(slot, enclose(groups[at(~child)]));
    }
}

}  // namespace vegetation_sim::scan
