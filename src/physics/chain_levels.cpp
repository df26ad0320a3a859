// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/chain_levels.h"

#include <algorithm>

#include "physics/chain_rows.h"

namespace vegetation_sim::physics {
namespace {

using Children = std::vector<std::vector<int>>;

// The tallest child first: it is the one that most parents have, and those fill whole vectors.
Children childrenOf(const std::vector<int>& parents, std::vector<int>& roots) {
  const std::size_t n = parents.size();
  std::vector<int> height(n, 0);
  for (std::size_t i = n; i-- > 0;)
    if (parents[i] >= 0) {
      int& below = height[static_cast<std::size_t>(parents[i])];
      below = std::max(below, height[i] + 1);
    }
  Children out(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<int>& siblings = parents[i] < 0 ? roots : out[static_cast<std::size_t>(parents[i])];
    siblings.push_back(static_cast<int>(i));
  }
  for (std::vector<int>& siblings : out)
    std::stable_sort(siblings.begin(), siblings.end(), [&](int a, int b) {
      return height[static_cast<std::size_t>(a)] > height[static_cast<std::size_t>(b)];
    });
  return out;
}

Brood broodOf(const std::vector<int>& level, const Children& children, std::size_t rank,
              std::vector<int>& next) {
  Brood out;
  for (std::size_t i = 0; i < level.size(); ++i) {
    out.first.push_back(static_cast<std::int32_t>(next.size()));
    const std::vector<int>& own = children[static_cast<std::size_t>(level[i])];
    if (own.size() <= rank) continue;
    next.push_back(own[rank]);
    out.parents = static_cast<int>(i) + 1;
  }
  out.end = static_cast<int>(next.size());
  // The widest vector reads on to the place after its last joint.
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
      ranks = std::max(ranks, children[joint].size());
    }
    for (std::size_t rank = 0; rank < ranks; ++rank)
      level.broods.push_back(broodOf(current, children, rank, next));
    levels.push_back(std::move(level));
    begin += (static_cast<int>(current.size()) + ROW - 1) / ROW * ROW;
    current.swap(next);
  }
  return begin;
}

}  // namespace vegetation_sim::physics
