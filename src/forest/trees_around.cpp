// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/trees_around.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim::forest {

std::vector<std::uint32_t> treesAround(const Layout& layout, const Vec3& centre, double radius) {
  std::vector<std::pair<double, std::uint32_t>> found;  // squared distance, id
  const auto add = [&](const TreeSeed& seed, std::uint32_t id) {
    const double x = seed.position.x() - centre.x(), y = seed.position.y() - centre.y();
    const double square = x * x + y * y;
    if (square <= radius * radius) found.push_back({square, id});
  };
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i) add(layout.trees[i], i);
  for (const Tile& tile : layout.tiles)
    for (const std::uint32_t i : findTreesInTile(tile, centre, radius))
      add(seedInTile(tile, i), tile.first_tree + i);
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> out;
  out.reserve(found.size());
  for (const auto& entry : found) out.push_back(entry.second);
  return out;
}

}  // namespace vegetation_sim::forest
