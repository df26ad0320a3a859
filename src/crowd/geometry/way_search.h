// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "crowd/geometry/plan_raster.h"

namespace vegetation_sim::crowd {

/// How far a search is. Together with the obstacles it determines all that the search holds.
struct WayProgress {
  std::uint32_t goal{0};    ///< cell where the search begins
  std::uint32_t origin{0};  ///< cell towards which it spreads first
  std::uint32_t closed{0};  ///< number of cells whose distance from the goal is known
};

/// Lengths of the shortest ways to one free cell, found from that cell on by reverse resumable A*
/// (Silver 2005): the cells between goal and origin come first, others when a query needs them. A
/// known length is that of Dijkstra's algorithm over all cells, in whatever order cells are asked.
/// All goals in the cell share the search.
class WaySearch {
 public:
  WaySearch(std::uint32_t goal, std::uint32_t origin) : progress_{goal, origin, 0} {}

  const WayProgress& progress() const { return progress_; }
  /// Closes up to `count` cells more. @return their number, which is less if no cell is left.
  std::size_t expand(const PlanRaster& raster, std::size_t count);
  /// Returns whether the lengths around the next part of the way from a cell are known.
  bool isKnown(const PlanRaster& raster, std::uint32_t cell) const;
  /// Finds the farthest visible place on the way from a free place. @return false if it is not
  /// known yet.
  bool aimFrom(const PlanRaster& raster, const Point& from, Point& aim) const;
  /// Frees what only an expansion needs.
  void shrink();
  /// Returns the memory of the search [bytes] after shrink().
  std::size_t bytes() const;

  static constexpr std::uint32_t BLOCK = 32;  ///< edge of a block of cells
  /// Most memory that closing a cell takes, but for the first [bytes].
  static constexpr std::size_t MOST_BYTES_A_CELL =
      std::size_t{4} * BLOCK * BLOCK + 8 * sizeof(std::uint32_t);

 private:
  using Block = std::array<std::uint8_t, BLOCK * BLOCK>;  ///< marks, row by row
  static constexpr int LOOK_AHEAD = 32;                   ///< cells along the way
  static constexpr std::uint32_t BUCKETS = 16;            ///< more than a step adds to an estimate
  using Path = std::array<std::uint32_t, LOOK_AHEAD>;

  void begin(const PlanRaster& raster);
  std::size_t blockOf(std::uint32_t column, std::uint32_t row) const {
    return row / BLOCK * block_columns_ + column / BLOCK;
  }
  static std::size_t placeInBlock(std::uint32_t column, std::uint32_t row) {
    return row % BLOCK * BLOCK + column % BLOCK;
  }
  std::uint8_t markAt(std::uint32_t column, std::uint32_t row) const;
  std::uint8_t& mark(std::uint32_t column, std::uint32_t row);
  std::uint32_t distanceFromOrigin(std::uint32_t column, std::uint32_t row) const;
  void open(const Neighbour& at, std::uint32_t length);
  bool findNext(const PlanRaster& raster, std::uint32_t cell, std::uint32_t& next) const;
  bool follow(const PlanRaster& raster, std::uint32_t cell, Path& path) const;

  WayProgress progress_;
  std::uint32_t columns_{0}, block_columns_{0};
  std::uint32_t origin_column_{0}, origin_row_{0};
  std::vector<std::unique_ptr<Block>> blocks_;  ///< null where no cell was reached
  std::size_t block_count_{0};
  /// Cells that are reached and not closed, by the estimated length of a way through them: the
  /// length up to the cell and the distance from the origin, modulo BUCKETS. The last comes first.
  std::array<std::vector<std::uint32_t>, BUCKETS> buckets_;
  std::size_t open_{0};
  std::uint32_t estimate_{0};  ///< least estimate of the open cells
};

}  // namespace vegetation_sim::crowd
