// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "crowd/geometry/obstacle_grid.h"

namespace vegetation_sim::crowd {

/// Costs of a step to a neighbour, in fifths of a cell.
constexpr std::uint32_t STRAIGHT = 5, DIAGONAL = 7;

/// A cell beside another one.
struct Neighbour {
  std::uint32_t cell, column, row;
  std::uint32_t cost;  ///< of the step to it
};

/// Cells of the plan that static obstacles block for a walker's centre.
class PlanRaster {
 public:
  PlanRaster() = default;
  /// @param clearance kept from every outline [m]. @param cell wanted edge [m]; increased if there
  /// would be more than half a million cells.
  PlanRaster(const ObstacleGrid& still, double clearance, double cell);

  bool empty() const { return blocked_.empty(); }
  /// Returns whether an obstacle is large enough for a detour.
  bool hasLarge() const { return has_large_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  /// Returns the cell, or the nearest one for a place outside.
  std::uint32_t cellAt(const Point& place) const;
  Point centreOf(std::uint32_t cell) const;
  bool isBlocked(std::uint32_t cell) const { return blocked_[cell] != 0; }
  /// Returns whether a way over free cells leads from one cell to the other.
  bool areConnected(std::uint32_t from, std::uint32_t to) const {
    return from == to || (regions_[from] != 0 && regions_[from] == regions_[to]);
  }
  /// Calls `each(neighbour)` for the free ones of the eight neighbours. Diagonal steps do not cut
  /// blocked corners.
  template <class Each>
  void visitNeighbours(std::uint32_t cell, Each each) const;
  /// Returns whether the straight line crosses no blocked cell, or none that a large obstacle
  /// blocks.
  bool isClear(const Point& from, const Point& to, bool large_only) const;
  /// Returns the place if it is free, else the centre of the nearest free cell within 2 m, else the
  /// place.
  Point nearestFree(const Point& place) const;

 private:
  void block(const Obstacle& obstacle, double clearance);
  void findRegions();

  Point origin_{};
  double cell_{1.0};
  int columns_{0}, rows_{0};
  bool has_large_{false};
  std::vector<std::uint8_t> blocked_;   ///< 0 free, 1 a small obstacle, 2 a large one
  std::vector<std::uint32_t> regions_;  ///< connected cells have the same number; 0: blocked
};

template <class Each>
void PlanRaster::visitNeighbours(std::uint32_t cell, Each each) const {
  struct Step {
    int column, row;
    std::uint32_t cost;
  };
  constexpr Step STEPS[8] = {{1, 0, STRAIGHT},   {0, 1, STRAIGHT}, {-1, 0, STRAIGHT},
                             {0, -1, STRAIGHT},  {1, 1, DIAGONAL}, {-1, 1, DIAGONAL},
                             {-1, -1, DIAGONAL}, {1, -1, DIAGONAL}};
  const int column = static_cast<int>(cell) % columns_, row = static_cast<int>(cell) / columns_;
  const auto at = [&](int c, int r) { return static_cast<std::uint32_t>(r * columns_ + c); };
  for (const Step& step : STEPS) {
    const int c = column + step.column, r = row + step.row;
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_ || isBlocked(at(c, r))) continue;
    if (step.cost == DIAGONAL && (isBlocked(at(c, row)) || isBlocked(at(column, r)))) continue;
    each(Neighbour{at(c, r), static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r),
                   step.cost});
  }
}

}  // namespace vegetation_sim::crowd
