// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "crowd/geometry/obstacle_grid.h"

namespace vegetation_sim::crowd {

/// Cells of the plan in which a walker's centre cannot be, because of obstacles that stand still.
class PlanRaster {
 public:
  PlanRaster() = default;
  /// @param clearance kept from every outline [m]. @param cell wanted edge [m]; larger where there
  /// would be more than half a million cells.
  PlanRaster(const ObstacleGrid& still, double clearance, double cell);

  bool empty() const { return blocked_.empty(); }
  /// There is an obstacle that is worth a detour.
  bool hasLarge() const { return has_large_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  std::uint32_t cellAt(const Point& place) const;  ///< the nearest one, for a place beyond the rim
  Point centreOf(std::uint32_t cell) const;
  bool isBlocked(std::uint32_t cell) const { return blocked_[cell] != 0; }
  /// The straight way between two places crosses no blocked cell; of large obstacles only, or all.
  bool isClear(const Point& from, const Point& to, bool large_only) const;
  /// The place itself, or the centre of the nearest free cell within 2 m; else the place.
  Point nearestFree(const Point& place) const;

 private:
  void block(const Obstacle& obstacle, double clearance);

  Point origin_{};
  double cell_{1.0};
  int columns_{0}, rows_{0};
  bool has_large_{false};
  std::vector<std::uint8_t> blocked_;  ///< 0 free, 1 a small obstacle, 2 a large one
};

/// Length of the way to one free cell from every cell, by steps to the eight neighbours (Dijkstra).
/// All goals in it share the field.
class FlowField {
 public:
  FlowField(const PlanRaster& raster, std::uint32_t cell);
  /// A place on the way from here to a goal in the cell, as far along it as can be seen; the goal
  /// itself where that can. @return false if no way leads there.
  bool aimFrom(const PlanRaster& raster, const Point& from, const Point& goal, Point& aim) const;
  bool isReachable(const PlanRaster& raster, const Point& from) const;

 private:
  static constexpr std::uint32_t FAR = 0xFFFFFFFFU;
  std::uint32_t next(const PlanRaster& raster, std::uint32_t cell) const;

  std::vector<std::uint32_t> length_;  ///< in fifths of a cell
};

/// Ways around obstacles that stand still, made when somebody needs them. They follow from
/// obstacles and goal alone, so what is kept changes only the cost.
class Ways {
 public:
  void setObstacles(const ObstacleGrid& still, double clearance, double cell);
  const PlanRaster& raster() const { return raster_; }
  /// The field of a goal; made if it is not there. Not for several threads at once.
  const FlowField& fieldOf(const Point& goal);
  /// Keeps no field.
  bool isReachable(const Point& from, const Point& goal) const;
  /// Forgets fields that were not asked for lately; at once where they take too much memory.
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
