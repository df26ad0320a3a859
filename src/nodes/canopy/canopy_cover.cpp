// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_cover.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vegetation_sim {
namespace {

constexpr double MOST_CELLS = 4e6;

/// Cells whose edges are at multiples of the resolution, so that maps of parts fit together.
struct CellGrid {
  double low_x{0.0}, low_y{0.0};  // number of the first cell
  double columns{0.0}, rows{0.0};
};

CellGrid gridOf(const canopy::Layout& layout, double resolution) {
  CellGrid out;
  if (layout.plants.empty()) return out;
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const canopy::Plant& plant : layout.plants)
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], std::floor(plant.position[i] / resolution));
      high[i] = std::max(high[i], std::floor(plant.position[i] / resolution));
    }
  return {low[0], low[1], high[0] - low[0] + 1.0, high[1] - low[1] + 1.0};
}

}  // namespace

CanopyCover::CanopyCover(const canopy::Layout& layout, double resolution) {
  CellGrid grid = gridOf(layout, resolution);
  while (grid.columns * grid.rows > MOST_CELLS) grid = gridOf(layout, resolution *= 2.0);
  info_.resolution = static_cast<float>(resolution);
  info_.width = static_cast<std::uint32_t>(grid.columns);
  info_.height = static_cast<std::uint32_t>(grid.rows);
  info_.origin.position.x = resolution * grid.low_x;
  info_.origin.position.y = resolution * grid.low_y;
  info_.origin.orientation.w = 1.0;
  plants_.assign(static_cast<std::size_t>(info_.width) * info_.height, 0);
  for (const canopy::Plant& plant : layout.plants) {
    cells_.push_back(-1);
    if (layout.kinds[plant.kind].shape == canopy::PlantShape::TRELLIS) continue;
    const auto column = static_cast<int>(std::floor(plant.position.x() / resolution) - grid.low_x);
    const auto row = static_cast<int>(std::floor(plant.position.y() / resolution) - grid.low_y);
    cells_.back() = row * static_cast<int>(info_.width) + column;
    ++plants_[static_cast<std::size_t>(cells_.back())];
  }
}

nav_msgs::OccupancyGrid CanopyCover::cutShare(const canopy::Stubble& stubble) const {
  std::vector<int> cut(plants_.size(), 0);
  for (const auto& entry : stubble)
    if (const int cell = cells_.at(entry.first); cell >= 0) ++cut[static_cast<std::size_t>(cell)];
  nav_msgs::OccupancyGrid out;
  out.info = info_;
  for (std::size_t i = 0; i < plants_.size(); ++i)
    out.data.push_back(
        plants_[i] == 0 ? std::int8_t{-1}
                        : static_cast<std::int8_t>((200 * cut[i] + plants_[i]) / (2 * plants_[i])));
  return out;
}

}  // namespace vegetation_sim
