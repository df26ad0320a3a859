// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/grass/blades/blade_batch.h"
#include "vegetation_sim/grass/lod/colour_mask.h"
#include "vegetation_sim/grass/tread/tread_law.h"
#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::grass {

/// Range of tiles, both ends included; empty if last < first.
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

/// Wind and colour at the nodes of tiles (paper 2, section 4.1): displacements of primitives are
/// summed as wind velocity and bounded where a blade bends; colours of masks are averaged (S2-18).
class NodeWind {
 public:
  /// The map and the terrain must outlive it.
  NodeWind(const FeatureMap& map, const terrain::HeightMap& terrain)
      : map_(map), terrain_(terrain) {}

  /// Evaluates the wind at the nodes of a window. The sum equals Instant::velocity on the ground
  /// bit by bit, but a bounded primitive costs only the nodes below its mask (S2-17). If `tiles` is
  /// given, only the corners of these tiles get wind.
  void update(const wind::Instant& wind, const std::vector<ColourMask>& masks,
              const TileWindow& window, const std::vector<TilePlace>* tiles = nullptr);

  /// Returns the wind at a node of the window [m/s].
  Vec3 at(int column, int row) const { return air_[indexOf(column, row)]; }
  /// Returns the colour at a node of the window, including masks.
  double colourAt(int column, int row) const;
  /// Writes wind and colour into a tile of the window.
  void fill(Tile& tile, TileMotion& motion) const;

  /// Returns how many nodes bounded primitives and masks reached in the last update, counted per
  /// mask.
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
  std::vector<Tint> tints_;           ///< [rows x columns] of nodes
  std::vector<std::size_t> asked_;    ///< indices of the nodes where the breeze is evaluated
  /// [6 x size of asked_] their places and wind, one component a row
  std::vector<double> rows_;
};

/// Returns the bend [rad] of grass with this compliance [rad s/m] in this wind [m/s], bounded
/// (S2-W4, E16).
Point bendIn(const Vec3& air, double compliance);

}  // namespace vegetation_sim::grass
