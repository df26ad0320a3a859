// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/tree_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vegetation_sim::forest {
namespace {

constexpr double CELL = 16.0;           // about the reach of a tree [m]
constexpr double MOST_CELLS = 1 << 30;  // [cells]
constexpr double MOST_ROWS = 1000;      // a search that is wider returns all trees
constexpr double ROUNDING = 1.0 + 1e-9;

std::int64_t cellOf(double x) {
  return static_cast<std::int64_t>(std::clamp(std::floor(x / CELL), -MOST_CELLS, MOST_CELLS));
}

// Keys rise by row, then by column.
std::uint64_t keyOf(std::int64_t row, std::int64_t column) {
  const auto positive = [](std::int64_t i) {
    return static_cast<std::uint64_t>(i + static_cast<std::int64_t>(MOST_CELLS));
  };
  return positive(row) << 32 | positive(column);
}

bool isWithin(const Vec3& foot, const Vec3& centre, double distance) {
  return length(foot - centre) <= distance;
}

// Returns a bound of the reach of a tree of each species at scale 1 [m].
std::vector<double> sizesOf(const Layout& layout) {
  std::vector<double> out;
  for (const Species& species : layout.species) out.push_back(sizeBound(species));
  return out;
}

std::vector<std::uint32_t> listAll(std::size_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

}  // namespace

TreeGrid::TreeGrid(const Layout& layout) : trees_(listAll(layout.trees.size())) {
  const std::vector<double> sizes = sizesOf(layout);
  std::vector<std::uint64_t> keys;
  keys.reserve(layout.trees.size());
  for (const TreeSeed& seed : layout.trees) {
    keys.push_back(keyOf(cellOf(seed.position.y()), cellOf(seed.position.x())));
    largest_size_ = std::max(largest_size_, seed.scale * sizes[seed.species]);
  }
  std::sort(trees_.begin(), trees_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  cells_.reserve(keys.size());
  for (const std::uint32_t tree : trees_) cells_.push_back(keys[tree]);
}

std::vector<std::uint32_t> TreeGrid::findCandidates(const Vec3& centre, double radius) const {
  const double distance = (largest_size_ + radius) * ROUNDING;
  if (!(2.0 * distance <= MOST_ROWS * CELL)) return listAll(trees_.size());
  const std::int64_t left = cellOf(centre.x() - distance), right = cellOf(centre.x() + distance);
  const std::int64_t last = cellOf(centre.y() + distance);
  std::vector<std::uint32_t> out;
  for (std::int64_t row = cellOf(centre.y() - distance); row <= last; ++row) {
    const auto begin = std::lower_bound(cells_.begin(), cells_.end(), keyOf(row, left));
    const auto end = std::upper_bound(begin, cells_.end(), keyOf(row, right));
    out.insert(out.end(), trees_.begin() + (begin - cells_.begin()),
               trees_.begin() + (end - cells_.begin()));
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::uint32_t> findTreesNear(const Layout& layout, const terrain::HeightMap& terrain,
                                         const Vec3& centre, double radius) {
  return findTreesNear(layout, nullptr, terrain, centre, radius);
}

std::vector<std::uint32_t> findTreesNear(const Layout& layout, const TreeGrid* grid,
                                         const terrain::HeightMap& terrain, const Vec3& centre,
                                         double radius) {
  const std::vector<double> sizes = sizesOf(layout);
  std::vector<std::uint32_t> out;
  const auto add = [&](const TreeSeed& seed, std::uint32_t id) {
    if (isWithin(footOf(seed, terrain), centre, seed.scale * sizes[seed.species] + radius))
      out.push_back(id);
  };
  for (const std::uint32_t tree :
       grid ? grid->findCandidates(centre, radius) : listAll(layout.trees.size()))
    add(layout.trees[tree], tree);
  double room = radius;
  for (const double size : sizes) room = std::max(room, LARGEST_TILED_SCALE * size + radius);
  for (const Tile& tile : layout.tiles) {
    if (centre.x() < tile.x - room || centre.x() > tile.x + tile.size + room ||
        centre.y() < tile.y - room || centre.y() > tile.y + tile.size + room)
      continue;
    for (const std::uint32_t i : findTreesInTile(tile, centre, room))
      add(seedInTile(tile, i), tile.first_tree + i);
  }
  return out;
}

}  // namespace vegetation_sim::forest
