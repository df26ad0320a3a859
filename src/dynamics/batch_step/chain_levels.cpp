// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/chain_levels.h"

#include <algorithm>

#include "dynamics/batch_step/chain_rows.h"

namespace vegetation_sim::physics {
namespace {

// The children of all joints in one list; those of joint i run from first[i] to first[i + 1].
struct Children {
  std::vector<int> first, joints;

  std::size_t count(int joint) const {
    const auto i = static_cast<std::size_t>(joint);
    return static_cast<std::size_t>(first[i + 1] - first[i]);
  }
  int of(int joint, std::size_t rank) const {
    return joints[static_cast<std::size_t>(first[static_cast<std::size_t>(joint)]) + rank];
  }
};

std::vector<int> heightsOf(const std::vector<int>& parents) {
  std::vector<int> out(parents.size(), 0);
  for (std::size_t i = parents.size(); i-- > 0;)
    if (parents[i] >= 0) {
      int& below = out[static_cast<std::size_t>(parents[i])];
      below = std::max(below, out[i] + 1);
    }
  return out;
}

// Sorts children by height, tallest first: most parents have such a child, so these fill whole
// vectors.
Children childrenOf(const std::vector<int>& parents, std::vector<int>& roots) {
  const std::size_t n = parents.size();
  Children out{std::vector<int>(n + 1, 0), std::vector<int>(n)};
  for (const int parent : parents)
    if (parent >= 0) ++out.first[static_cast<std::size_t>(parent) + 1];
  for (std::size_t i = 0; i < n; ++i) out.first[i + 1] += out.first[i];
  std::vector<int> end(out.first.begin(), out.first.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (parents[i] < 0)
      roots.push_back(static_cast<int>(i));
    else
      out.joints[static_cast<std::size_t>(end[static_cast<std::size_t>(parents[i])]++)] =
          static_cast<int>(i);
  }
  const std::vector<int> height = heightsOf(parents);
  for (std::size_t i = 0; i < n; ++i)
    std::sort(out.joints.begin() + out.first[i], out.joints.begin() + end[i], [&](int a, int b) {
      const int ha = height[static_cast<std::size_t>(a)], hb = height[static_cast<std::size_t>(b)];
      return ha != hb ? ha > hb : a < b;
    });
  return out;
}

ChildRank broodOf(const std::vector<int>& level, const Children& children, std::size_t rank,
                  std::vector<int>& next) {
  ChildRank out;
  out.first.reserve(level.size() + ROW + 1);
  for (std::size_t i = 0; i < level.size(); ++i) {
    out.first.push_back(static_cast<std::int32_t>(next.size()));
    if (children.count(level[i]) <= rank) continue;
    next.push_back(children.of(level[i], rank));
    out.parents = static_cast<int>(i) + 1;
  }
  out.end = static_cast<int>(next.size());
  // The widest vector reads on to the entry after its last joint.
  const auto parents = static_cast<std::size_t>(out.parents);
  out.first.resize(parents);
  out.first.resize(parents + ROW + 1, out.end);
  return out;
}

}  // namespace

int sortIntoLevels(const std::vector<int>& parents, int begin, std::vector<Level>& levels,
                   std::vector<int>& slots) {
  const std::size_t offset = slots.size();
  slots.resize(offset + parents.size());
  std::vector<int> current, next;
  const Children children = childrenOf(parents, current);
  while (!current.empty()) {
    Level level{begin, static_cast<int>(current.size()), {}};
    next.clear();
    std::size_t ranks = 0;
    for (std::size_t i = 0; i < current.size(); ++i) {
      const auto joint = static_cast<std::size_t>(current[i]);
      slots[offset + joint] = begin + static_cast<int>(i);
      ranks = std::max(ranks, children.count(current[i]));
    }
    for (std::size_t rank = 0; rank < ranks; ++rank)
      level.child_ranks.push_back(broodOf(current, children, rank, next));
    levels.push_back(std::move(level));
    begin += (static_cast<int>(current.size()) + ROW - 1) / ROW * ROW;
    current.swap(next);
  }
  return begin;
}

}  // namespace vegetation_sim::physics
