// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/grass/map/grass_species.h"
#include "vegetation_sim/terrain/grey_image.h"

namespace vegetation_sim::grass {

/// Grid of a meadow. Nodes stand on the corners of the tiles: 51 columns at 2 m cover 100 m.
struct MapLaw {
  double resolution{2.0};  ///< distance of neighbouring nodes, side of a tile [m]
  double origin_x{0.0};    ///< world position of the south-west node [m]
  double origin_y{0.0};
  int columns{51};  ///< nodes along x; given by the pictures if there are any
  int rows{51};     ///< nodes along y
};
void describe(FieldVisitor& visitor, MapLaw& law);

/// One quantity at the nodes: a constant, or a grey image whose top row is in the north.
struct LayerInput {
  double value{0.0};  ///< value if there is no image
  terrain::GreyImage image{};
  double black{0.0};  ///< value of black
  double white{1.0};  ///< value of white
};

/// A species and its share in the mix, relative to the shares of the others.
struct SpeciesInput {
  Species species{};
  LayerInput mix{1.0, {}, 0.0, 1.0};
};

/// Inputs of a feature map; without species it has the default one.
struct MapInput {
  MapLaw law{};
  LayerInput height{0.3, {}, 0.0, 0.5};        ///< [m]
  LayerInput density{400.0, {}, 0.0, 1000.0};  ///< [blades/m^2]
  LayerInput colour{0.0, {}, 0.0, 1.0};        ///< 0 fresh to 1 dry
  LayerInput shape{0.5, {}, 0.0, 1.0};         ///< 0 upright to 1 drooping
  std::vector<SpeciesInput> species{};
};

/// Reads the keys of docs/grass.md; paths of images are relative to `folder`. The caller calls
/// finish(); FeatureMap checks the values.
MapInput readMapInput(YamlSection& yaml, const std::string& folder);

/// Grass at one place; shares of species are in the order of the map.
struct Features {
  double height{0.0};   ///< [m]
  double density{0.0};  ///< [blades/m^2]
  double colour{0.0};
  double shape{0.0};
  std::array<double, MAX_SPECIES> mix{};
};

/// Means of the four nodes of a tile.
struct TileMeans {
  double height{0.0}, density{0.0};  ///< [m], [blades/m^2]
};

/// A meadow as a continuous medium (paper 2, section 3.1): features at the nodes of a uniform grid,
/// bilinear between them, zero beyond the border. Immutable, hence safe to read from any thread.
class FeatureMap {
 public:
  /// Makes the default meadow.
  FeatureMap() : FeatureMap(MapInput()) {}
  /// @throws InvalidInput with all faults.
  explicit FeatureMap(MapInput input);
  /// Reads a YAML file with the keys of docs/grass.md and its images, whose paths are relative to
  /// it. @throws InvalidInput with all faults, each with file, key, value and allowed range.
  static FeatureMap load(const std::string& file);

  const MapLaw& law() const { return input_.law; }
  /// Returns the inputs that the map was made from.
  const MapInput& input() const { return input_; }
  int tileColumns() const { return input_.law.columns - 1; }
  int tileRows() const { return input_.law.rows - 1; }
  const std::vector<SpeciesInput>& species() const { return input_.species; }

  /// Returns the features at a node. Requires 0 <= column < columns, 0 <= row < rows; row 0 is in
  /// the south.
  Features node(int column, int row) const;
  /// Returns the features at (x, y) [m]; density is 0 beyond the border and for a NaN.
  Features at(double x, double y) const;
  /// Returns the means that levels of detail depend on. Requires a tile of the map.
  TileMeans meansOf(int tile_column, int tile_row) const;
  /// Returns the largest height of any blade of the map [m].
  double tallest() const { return tallest_; }
  std::uint64_t hash() const { return hash_; }

 private:
  MapInput input_;
  double tallest_{0.0};
  std::uint64_t hash_{0};
};

/// Largest number of blades that a tile may hold.
constexpr int MAX_BLADES = 1 << 20;

}  // namespace vegetation_sim::grass
