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

/// What the blades of one species have in common, in single precision.
struct BladeSpecies {
  float height{1.f}, spread{0.f}, lean{0.f}, compliance{0.f};
};

/// A square of a meadow between four nodes, with all that its blades follow from: nothing of a
/// blade is stored (S2-05). Made when somebody looks, the same each time.
struct Tile {
  int column{0}, row{0};
  std::uint64_t key{0};  ///< of its random numbers
  int blades{0};
  double x{0.0}, y{0.0}, z{0.0};  ///< south-west corner on the ground, world [m]
  float size{1.f};                ///< [m]
  Corners density{}, height{}, colour{}, shape{};
  int species_count{1};
  std::array<BladeSpecies, MAX_SPECIES> species{};
  std::array<Corners, MAX_SPECIES> shares{};  ///< sum of the shares of species 0 to s
  bool sloped{false};
  int ground_cells{1};        ///< along each side
  std::vector<float> ground;  ///< [(cells + 1) x (cells + 1)] above z, south row first; sloped only
};

/// Requires 0 <= column < map.tileColumns() and 0 <= row < map.tileRows().
Tile makeTile(const FeatureMap& map, const terrain::HeightMap& terrain, std::uint64_t seed,
              int column, int row);

/// Number of blades: area times the mean of the corners' densities (S2-04), rounded up or down by
/// chance so that it is right on average. @param chance uniform in [0, 1).
int bladeCount(const Corners& density, float size, double chance);

}  // namespace vegetation_sim::grass
