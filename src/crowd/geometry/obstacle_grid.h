// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "crowd/geometry/obstacle.h"

namespace vegetation_sim::crowd {

/// Static obstacles in a uniform grid; each is in all cells that it covers. Immutable, hence
/// thread-safe.
class ObstacleGrid {
 public:
  ObstacleGrid() = default;
  /// @param cell wanted edge [m]. It is increased if there would be more than a million cells, or
  /// more than two million entries, or nine per obstacle.
  ObstacleGrid(std::vector<Obstacle> obstacles, double cell);

  /// Returns the obstacles in the order of their cells, not in that of the constructor.
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  /// Entry of an obstacle in a cell, with its bounding circle.
  struct Spot {
    Point centre;
    double reach;  ///< [m]
    std::uint32_t index;
    int column;                    ///< column of this cell
    bool is_disc;                  ///< the obstacle is a disc
    bool first_column, first_row;  ///< the cell is in the first column or row of the obstacle
  };
  /// Calls `visit(spot)` once for each obstacle whose cells come within `range` of a place, in an
  /// order that depends only on the place.
  template <class Visit>
  void visitNear(const Point& place, double range, Visit visit) const {
    if (obstacles_.empty()) return;
    const int c0 = column(place.x - range), c1 = column(place.x + range);
    const int r0 = row(place.y - range), r1 = row(place.y + range);
    // Reads all rows at once instead of one after the other.
    for (int r = r0; r <= r1; ++r)
      __builtin_prefetch(spots_.data() + starts_[static_cast<std::size_t>(r) * columns_ + c0]);
    for (int r = r0; r <= r1; ++r) {
      const std::size_t row_start = static_cast<std::size_t>(r) * columns_;
      const std::uint32_t end = starts_[row_start + c1 + 1];
      for (std::uint32_t i = starts_[row_start + c0]; i < end; ++i) {
        const Spot& spot = spots_[i];
        // An obstacle in several of the cells is visited only in the first of them.
        if ((spot.first_column || spot.column == c0) && (spot.first_row || r == r0)) visit(spot);
      }
    }
  }

 private:
  int clampTo(double cells, int count) const {
    return static_cast<int>(std::min(std::max(cells, 0.0), count - 1.0));
  }
  int column(double x) const { return clampTo((x - origin_.x) * per_metre_, columns_); }
  int row(double y) const { return clampTo((y - origin_.y) * per_metre_, rows_); }

  std::vector<Obstacle> obstacles_;
  Point origin_{};
  double per_metre_{1.0};
  int columns_{0}, rows_{0};
  std::vector<std::uint32_t> starts_;  ///< [cells + 1] into `spots_`
  std::vector<Spot> spots_;
};

/// Bounding box of an obstacle's outline.
struct Extent {
  Point low, high;
};
Extent extentOf(const Obstacle& obstacle);

}  // namespace vegetation_sim::crowd
