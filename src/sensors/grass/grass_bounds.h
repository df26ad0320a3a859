// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grass/lod/node_wind.h"
#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::scan {

/// Upper bounds of the extinction of grass, trodden or not, by tile and height, so that most cells
/// on a ray's way need no evaluation of the grass in them.
class GrassBounds {
 public:
  void setMap(const grass::FeatureMap& map);
  /// @param air wind of the tiles in `window`, or null in still air.
  void setWind(const grass::NodeWind* air, const grass::TileWindow& window);
  void setTread(const grass::TreadMap& tread);

  /// Returns a bound for rays of any direction at a place of the world and a height above the
  /// ground [1/m]; 0 where there is no grass.
  double at(double x, double y, double height) const {
    const std::size_t tile = tileAt(x, y);
    if (tile == NO_TILE) return 0.0;
    const std::size_t band = tile * BANDS + bandOf(height);
    if (trodden_[tile] != 0 && isTrodden(x, y)) return double{trodden_bound_[band]};
    return double{still_[band]} * double{bent_[tile]};
  }
  /// Returns the edge of squares within which at() varies with the height alone, or is that of a
  /// corner: the largest one at the corners of a smaller box bounds all of it.
  double edge() const { return std::min(tile_, grass::TreadBlock::SIDE * spacing_); }

 private:
  static constexpr int BANDS = 16;
  static constexpr std::size_t NO_TILE = SIZE_MAX;
  std::size_t bandOf(double height) const {
    return static_cast<std::size_t>(std::min(std::max(height * per_band_, 0.0), BANDS - 1.0));
  }
  std::size_t tileAt(double x, double y) const {
    // The division is that of FeatureMap::at(), so that the tile is the same.
    const double u = (x - origin_x_) / tile_, v = (y - origin_y_) / tile_;
    if (!(u >= 0.0 && v >= 0.0 && u < columns_ && v < rows_)) return NO_TILE;
    return static_cast<std::size_t>(static_cast<int>(v) * columns_ + static_cast<int>(u));
  }
  struct Kind {
    double lean, compliance;
  };
  bool isTrodden(double x, double y) const;
  double bentBy(double wind, double shape) const;

  double origin_x_{0.0}, origin_y_{0.0}, tile_{1.0}, per_band_{1.0};
  int columns_{0}, rows_{0};  ///< of tiles
  std::vector<Kind> kinds_;
  std::vector<float> still_;          ///< [rows x columns x BANDS] of upright blades [1/m]
  std::vector<float> trodden_bound_;  ///< the same of blades that lean in any way [1/m]
  std::vector<float> shape_;          ///< [rows x columns] largest shape of the corners
  std::vector<float> still_bent_;     ///< [rows x columns] factor for blades that lean in still air
  std::vector<float> bent_;           ///< [rows x columns] the same in the wind
  std::vector<std::uint8_t> trodden_;  ///< [rows x columns] any block of trodden ground is near
  double spacing_{1.0};                ///< of the nodes of trodden ground [m]
  int block_columns_{0}, block_rows_{0};
  std::vector<std::uint8_t> trodden_blocks_;  ///< [block_rows_ x block_columns_]
};

}  // namespace vegetation_sim::scan
