// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "crowd/geometry/obstacle_grid.h"

namespace vegetation_sim::crowd {

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
  /// Returns whether the straight line crosses no blocked cell, or none that a large obstacle
  /// blocks.
  bool isClear(const Point& from, const Point& to, bool large_only) const;
  /// Returns the place if it is free, else the centre of the nearest free cell within 2 m, else the
  /// place.
  Point nearestFree(const Point& place) const;

 private:
  void block(const Obstacle& obstacle, double clearance);

  Point origin_{};
  double cell_{1.0};
  int columns_{0}, rows_{0};
  bool has_large_{false};
  std::vector<std::uint8_t> blocked_;  ///< 0 free, 1 a small obstacle, 2 a large one
};

/// Lengths of the shortest ways from all cells to one free cell over eight neighbours (Dijkstra).
/// All goals in that cell share the field.
class FlowField {
 public:
  FlowField(const PlanRaster& raster, std::uint32_t cell);
  /// Finds the farthest visible place on the way to a goal in the cell, or the goal itself if it is
  /// visible. @return false if there is no way.
  bool aimFrom(const PlanRaster& raster, const Point& from, const Point& goal, Point& aim) const;
  bool isReachable(const PlanRaster& raster, const Point& from) const;

 private:
  static constexpr std::uint32_t FAR = 0xFFFFFFFFU;
  std::uint32_t next(const PlanRaster& raster, std::uint32_t cell) const;

  std::vector<std::uint32_t> length_;  ///< in fifths of a cell
};

/// Ways around static obstacles, computed on demand. They depend only on obstacles and goal, so
/// caching changes only the cost.
class Ways {
 public:
  void setObstacles(const ObstacleGrid& still, double clearance, double cell);
  const PlanRaster& raster() const { return raster_; }
  /// Returns the field of a goal, which is computed if necessary. Not thread-safe.
  const FlowField& fieldOf(const Point& goal);
  /// Does not cache the field.
  bool isReachable(const Point& from, const Point& goal) const;
  /// Frees fields that were not used for some ticks, and earlier if they take too much memory.
  void endTick();
  std::size_t count() const { return fields_.size(); }

 private:
  struct Kept {
    std::unique_ptr<FlowField> field;
    std::uint64_t asked{0};
  };
  std::uint32_t freeCell(const Point& goal) const {
    return raster_.cellAt(raster_.nearestFree(goal));
  }

  PlanRaster raster_;
  std::map<std::uint32_t, Kept> fields_;  ///< by the goal's cell, or the nearest free one
  std::uint64_t tick_{0};
};

}  // namespace vegetation_sim::crowd
