// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/tree_regions.h"

#include <algorithm>
#include <utility>

#include "core/math/morton.h"

namespace vegetation_sim::forest {
namespace {

// Returns a ball around `count` balls: around the box that contains them.
template <class BallOf>
Ball enclose(std::size_t first, std::size_t end, const BallOf& ball_of) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (std::size_t i = first; i < end; ++i) {
    const Ball& ball = ball_of(i);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], ball.centre[axis] - ball.reach);
      high[axis] = std::max(high[axis], ball.centre[axis] + ball.reach);
    }
  }
  const Vec3 half = 0.5 * (high - low);
  return {low + half, length(half) * (1.0 + 1e-9)};
}

}  // namespace

TreeRegions::TreeRegions(std::vector<Region> regions) {
  std::vector<std::pair<std::uint64_t, std::size_t>> row;  // key and index
  row.reserve(regions.size());
  for (const Region& region : regions)
    row.emplace_back(mortonKey(region.ball.centre.x(), region.ball.centre.y()), row.size());
  std::sort(row.begin(), row.end());
  regions_.reserve(regions.size());
  for (const auto& [key, index] : row) regions_.push_back(regions[index]);

  const auto addLevel = [this](std::size_t count, const auto& ball_of) {
    std::vector<Ball> level;
    for (std::size_t i = 0; i < count; i += CHILDREN)
      level.push_back(enclose(i, std::min(i + CHILDREN, count), ball_of));
    levels_.push_back(std::move(level));
  };
  if (regions_.empty()) return;
  addLevel(regions_.size(), [this](std::size_t i) -> const Ball& { return regions_[i].ball; });
  while (levels_.back().size() > CHILDREN) {
    const std::vector<Ball> below = levels_.back();
    addLevel(below.size(), [&below](std::size_t i) -> const Ball& { return below[i]; });
  }
}

}  // namespace vegetation_sim::forest
