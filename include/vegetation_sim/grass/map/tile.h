// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::grass {

/// Values at the corners of a tile: south-west, south-east, north-west, north-east.
using Corners = std::array<float, 4>;

/// Properties of a species in single precision.
struct BladeSpecies {
  float height{1.f}, spread{0.f}, lean{0.f}, compliance{0.f};
};

/// A square of a meadow between four nodes. All of its blades follow from it, so no blade is stored
/// (S2-05). It is made again whenever it is needed.
struct Tile {
  int column{0}, row{0};
  std::uint64_t key{0};  ///< key of its random numbers
  int blades{0};
  double x{0.0}, y{0.0}, z{0.0};  ///< south-west corner on the ground, world [m]
  float size{1.f};                ///< [m]
  Corners density{}, height{}, colour{}, shape{};
  int species_count{1};
  std::array<BladeSpecies, MAX_SPECIES> species{};
  std::array<Corners, MAX_SPECIES> shares{};  ///< sums of the shares of species 0 to s
  bool sloped{false};
  int ground_cells{1};  ///< cells along each side
  /// height above z at [(cells + 1) x (cells + 1)] nodes, south row first; empty if flat
  std::vector<float> ground;
};

/// Makes a tile. Requires 0 <= column < map.tileColumns() and 0 <= row < map.tileRows().
Tile makeTile(const FeatureMap& map, const terrain::HeightMap& terrain, std::uint64_t seed,
              int column, int row);

/// Returns the number of blades: area times the mean density of the corners (S2-04), rounded up or
/// down at random so that it is right on average. @param chance uniform in [0, 1).
int bladeCount(const Corners& density, float size, double chance);

}  // namespace vegetation_sim::grass
