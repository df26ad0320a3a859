// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "crowd/geometry/obstacle.h"

namespace vegetation_sim::crowd {

/// Obstacles that stand still, found by place: a uniform grid in which each stands in every cell
/// that it covers. Immutable; any number of threads may ask.
class ObstacleGrid {
 public:
  ObstacleGrid() = default;
  /// @param cell wanted edge [m]; larger where there would be more than a million cells, or
  /// obstacles would stand in more than two million, or nine each.
  ObstacleGrid(std::vector<Obstacle> obstacles, double cell);

  /// In the order of their cells, not in that of the constructor.
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  /// Circle about an obstacle, as it stands in the cells.
  struct Spot {
    Point centre;
    double reach;  ///< [m]
    std::uint32_t index;
    int column;                    ///< of this cell
    bool is_disc;                  ///< the circle is all of it
    bool first_column, first_row;  ///< of the obstacle's cells
  };
  /// Calls `visit(spot)` once for each obstacle whose cells come within `range` of a place, in an
  /// order that depends on the place alone.
  template <class Visit>
  void visitNear(const Point& place, double range, Visit visit) const {
    if (obstacles_.empty()) return;
    const int c0 = column(place.x - range), c1 = column(place.x + range);
    const int r0 = row(place.y - range), r1 = row(place.y + range);
    // All rows are asked for at once, not one after the other.
    for (int r = r0; r <= r1; ++r)
      __builtin_prefetch(spots_.data() + starts_[static_cast<std::size_t>(r) * columns_ + c0]);
    for (int r = r0; r <= r1; ++r) {
      const std::size_t row_start = static_cast<std::size_t>(r) * columns_;
      const std::uint32_t end = starts_[row_start + c1 + 1];
      for (std::uint32_t i = starts_[row_start + c0]; i < end; ++i) {
        const Spot& spot = spots_[i];
        // An obstacle in several of the cells is told of in the first of them only.
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

/// Box about an obstacle's outline.
struct Extent {
  Point low, high;
};
Extent extentOf(const Obstacle& obstacle);

}  // namespace vegetation_sim::crowd
