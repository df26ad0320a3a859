// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/tile.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

constexpr int MAX_GROUND_CELLS = 32;

float narrow(double x) {
  return static_cast<float>(x);
}

void setFeatures(const FeatureMap& map, Tile& tile) {
  for (int corner = 0; corner < 4; ++corner) {
    const auto k = static_cast<std::size_t>(corner);
    const Features f = map.node(tile.column + corner % 2, tile.row + corner / 2);
    tile.density[k] = narrow(f.density);
    tile.height[k] = narrow(f.height);
    tile.colour[k] = narrow(f.colour);
    tile.shape[k] = narrow(f.shape);
    double sum = 0.0;
    for (std::size_t s = 0; s < map.species().size(); ++s)
      tile.shares[s][k] = narrow(sum += f.mix[s]);
  }
  tile.species_count = static_cast<int>(map.species().size());
  for (std::size_t s = 0; s < map.species().size(); ++s) {
    const Species& from = map.species()[s].species;
    tile.species[s] = {narrow(from.height), narrow(from.height_spread), narrow(from.lean),
                       narrow(from.compliance)};
  }
}

void setGround(const terrain::HeightMap& terrain, double size, Tile& tile) {
  tile.z = terrain.height(tile.x, tile.y);
  if (terrain.isFlat()) return;
  const double cells = std::ceil(size / terrain.resolution());
  const int n = static_cast<int>(std::min(std::max(cells, 1.0), double{MAX_GROUND_CELLS}));
  tile.sloped = true;
  tile.ground_cells = n;
  tile.ground.reserve(static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n + 1));
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column)
      tile.ground.push_back(
          narrow(terrain.height(tile.x + size * column / n, tile.y + size * row / n) - tile.z));
}

}  // namespace

int bladeCount(const Corners& density, float size, double chance) {
  const double mean = (double{density[0]} + density[1] + density[2] + density[3]) / 4.0;
  const double area = double{size} * size;
  return static_cast<int>(std::min(std::floor(area * mean + chance), double{MAX_BLADES}));
}

Tile makeTile(const FeatureMap& map, const terrain::HeightMap& terrain, std::uint64_t seed,
              int column, int row) {
  const MapLaw& law = map.law();
  Tile tile;
  tile.column = column;
  tile.row = row;
  const auto place = static_cast<std::uint64_t>(row) << 32 | static_cast<std::uint64_t>(column);
  const Random random = Random(seed).child(place);
  tile.key = random.key();
  tile.x = law.origin_x + law.resolution * column;
  tile.y = law.origin_y + law.resolution * row;
  tile.size = narrow(law.resolution);
  setFeatures(map, tile);
  setGround(terrain, law.resolution, tile);
  tile.blades = bladeCount(tile.density, tile.size, random.uniform(0));
  return tile;
}

}  // namespace vegetation_sim::grass
