// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/tree_errors.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim::forest {
namespace {

// Calls `visit` for the sizes of all trees; for tiles, for the range of their sizes.
void forEachSize(const Layout& layout,
                 const std::function<void(std::size_t species, double scale)>& visit) {
  for (const TreeSeed& seed : layout.trees) visit(seed.species, seed.scale);
  for (std::size_t species = 0; species < layout.species.size() && !layout.tiles.empty(); ++species)
    for (const double scale : {SMALLEST_TILED_SCALE, 1.0, LARGEST_TILED_SCALE})
      visit(species, scale);
}

}  // namespace

void TreeErrors::measureSpecies(const Layout& layout, std::size_t species, double scale) {
  tables_[species].measure(layout.species[species], layout.motion, scale);
  const LevelTable table = tables_[species].at(scale);
  extent_ = std::max(extent_, table.reach + table.height);
  largest_omission_ = std::max(largest_omission_, table.omitted[0]);
  slowest_reference_ = std::min(slowest_reference_, layout.species[species].reference_speed);
}

void TreeErrors::measure(const Layout& layout, const terrain::HeightMap& terrain,
                         const TreeOwners& owners) {
  tables_.assign(layout.species.size(), LevelScales());
  extent_ = largest_omission_ = 0.0;
  slowest_reference_ = 1e9;
  forEachSize(layout,
              [&](std::size_t species, double scale) { measureSpecies(layout, species, scale); });
  const terrain::Bounds bounds = terrain.bounds();
  const double relief = bounds.max_z - bounds.min_z;
  std::vector<TreeRegions::Region> regions;
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i)
    if (owners.owns(i)) regions.push_back({{footOf(layout.trees[i], terrain), extent_}, i, 1});
  for (const Tile& tile : layout.tiles) {
    if (!owners.owns(tile.first_tree)) continue;
    const double half = 0.5 * tile.size;
    const Vec3 centre(tile.x + half, tile.y + half, terrain.height(tile.x + half, tile.y + half));
    regions.push_back({{centre, half * 1.5 + relief + extent_}, tile.first_tree, tile.count});
  }
  regions_ = TreeRegions(std::move(regions));
}

void TreeErrors::precompute(const Layout& layout) {
  forEachSize(layout, [&](std::size_t species, double scale) {
    tables_[species].responseErrorAt(layout.species[species], layout.motion, scale, {});
  });
}

PredictedError TreeErrors::responseErrorOf(const Layout& layout, const TreeSeed& seed,
                                           const wind::GustSpectrum& spectrum) {
  return tables_[seed.species].responseErrorAt(layout.species[seed.species], layout.motion,
                                               seed.scale, spectrum);
}

}  // namespace vegetation_sim::forest
