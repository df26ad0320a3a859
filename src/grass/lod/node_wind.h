// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/grass/blades/blade_batch.h"
#include "vegetation_sim/grass/tread/tread_law.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::grass {

/// Tiles from first to last, both included; empty if last < first.
struct TileWindow {
  int first_column{0}, last_column{-1}, first_row{0}, last_row{-1};
  bool has(int column, int row) const {
    return column >= first_column && column <= last_column && row >= first_row && row <= last_row;
  }
};

/// Column and row of a tile.
struct TilePlace {
  int column{0}, row{0};
};

/// A disc that colours the grass, strongest in its middle: a mown, dry or fertilised patch.
struct ColourMask {
  Point centre{};      ///< [m]
  double radius{1.0};  ///< [m]
  double colour{1.0};  ///< towards which it draws, 0 fresh to 1 dry
  double weight{1.0};  ///< beside the grass itself, which has 1
};

/// What primitives send to the nodes under their masks (paper 2, section 4.1): displacements are
/// summed, as air velocity, and bounded where a blade bends; colours are averaged (S2-18).
class NodeWind {
 public:
  /// Both must outlive it.
  NodeWind(const FeatureMap& map, const terrain::HeightMap& terrain)
      : map_(map), terrain_(terrain) {}

  /// Evaluates the wind law at the nodes of a window: the sum is Instant::velocity on the ground,
  /// bit by bit, but a bounded primitive costs only the nodes that its mask covers (S2-17).
  /// With `tiles`, nodes that are no corner of one of them are left without air.
  void update(const wind::Instant& wind, const std::vector<ColourMask>& masks,
              const TileWindow& window, const std::vector<TilePlace>* tiles = nullptr);

  /// Air at a node of the window [m/s].
  Vec3 at(int column, int row) const { return air_[indexOf(column, row)]; }
  /// Colour at a node of the window, masks included.
  double colourAt(int column, int row) const;
  /// Writes air and colour of a tile of the window.
  void fill(Tile& tile, TileMotion& motion) const;

  /// Nodes that bounded primitives and masks reached in the last update, each counted per mask.
  int touched() const { return touched_; }

 private:
  struct Tint {
    double weight{0.0}, sum{0.0};
  };
  struct Span {
    int first_column, last_column, first_row, last_row;
  };
  std::size_t indexOf(int column, int row) const;
  Vec3 placeOf(int column, int row) const;
  Span spanOf(double min_x, double max_x, double min_y, double max_y) const;
  void want(const std::vector<TilePlace>* tiles);
  void blow(const wind::Instant& wind);
  Span maskOf(const wind::Term& term) const;

  const FeatureMap& map_;
  const terrain::HeightMap& terrain_;
  TileWindow window_;
  int columns_{0};
  int touched_{0};
  std::vector<std::uint8_t> wanted_;  ///< [rows x columns] of nodes
  std::vector<Vec3> air_;             ///< [rows x columns] of nodes
  std::vector<Tint> tints_;           ///< likewise
  std::vector<std::size_t> asked_;    ///< nodes that the breeze is asked at: indices
  std::vector<double> rows_;          ///< [6 x asked] their places and air, a row a component
};

/// Bend of grass of this compliance [rad s/m] in this air [m/s], bounded (S2-W4, E16) [rad].
Point bendIn(const Vec3& air, double compliance);

}  // namespace vegetation_sim::grass
