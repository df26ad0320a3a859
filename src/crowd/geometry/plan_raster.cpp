// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/plan_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_RASTER_CELLS = 524288.0;
constexpr double RIM = 3.0;     ///< margin around all obstacles [m]
constexpr double LARGE = 0.9;   ///< least reach of an obstacle that is worth a detour [m]
constexpr double SEARCH = 2.0;  ///< radius of the search for a free cell [m]

}  // namespace

PlanRaster::PlanRaster(const ObstacleGrid& still, double clearance, double cell) : cell_(cell) {
  if (still.obstacles().empty()) return;
  Extent all = extentOf(still.obstacles().front());
  for (const Obstacle& o : still.obstacles()) {
    const Extent e = extentOf(o);
    all.low = {std::min(all.low.x, e.low.x), std::min(all.low.y, e.low.y)};
    all.high = {std::max(all.high.x, e.high.x), std::max(all.high.y, e.high.y)};
  }
  origin_ = {all.low.x - RIM, all.low.y - RIM};
  const Point size{all.high.x + RIM - origin_.x, all.high.y + RIM - origin_.y};
  while ((size.x / cell_ + 1.0) * (size.y / cell_ + 1.0) > MOST_RASTER_CELLS) cell_ *= 1.25;
  columns_ = static_cast<int>(size.x / cell_) + 1;
  rows_ = static_cast<int>(size.y / cell_) + 1;
  blocked_.assign(static_cast<std::size_t>(columns_) * rows_, 0);
  for (const Obstacle& o : still.obstacles()) block(o, clearance);
  findRegions();
}

void PlanRaster::findRegions() {
  regions_.assign(blocked_.size(), 0);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t first = 0; first < regions_.size(); ++first) {
    if (isBlocked(first) || regions_[first] != 0) continue;
    regions_[first] = ++count;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const std::uint32_t cell = waiting.back();
      waiting.pop_back();
      visitNeighbours(cell, [&](const Neighbour& next) {
        if (regions_[next.cell] != 0) return;
        regions_[next.cell] = count;
        waiting.push_back(next.cell);
      });
    }
  }
}

void PlanRaster::block(const Obstacle& obstacle, double clearance) {
  const Extent e = extentOf(obstacle);
  const std::uint8_t mark = obstacle.reach >= LARGE ? 2 : 1;
  has_large_ = has_large_ || mark == 2;
  const std::uint32_t first = cellAt({e.low.x - clearance, e.low.y - clearance});
  const std::uint32_t last = cellAt({e.high.x + clearance, e.high.y + clearance});
  const auto width = static_cast<std::uint32_t>(columns_);
  for (std::uint32_t row = first / width; row <= last / width; ++row)
    for (std::uint32_t column = first % width; column <= last % width; ++column) {
      std::uint8_t& cell = blocked_[row * width + column];
      if (cell >= mark) continue;
      if (separation(centreOf(row * width + column), clearance, obstacle, 0.0).overlapping)
        cell = mark;
    }
}

std::uint32_t PlanRaster::cellAt(const Point& place) const {
  const double c = std::min(std::max((place.x - origin_.x) / cell_, 0.0), columns_ - 1.0);
  const double r = std::min(std::max((place.y - origin_.y) / cell_, 0.0), rows_ - 1.0);
  return static_cast<std::uint32_t>(r) * static_cast<std::uint32_t>(columns_) +
         static_cast<std::uint32_t>(c);
}

Point PlanRaster::centreOf(std::uint32_t cell) const {
  const auto width = static_cast<std::uint32_t>(columns_);
  const std::uint32_t column = cell % width, row = cell / width;
  return {origin_.x + (column + 0.5) * cell_, origin_.y + (row + 0.5) * cell_};
}

// Samples every half cell; the samples can only miss the corner of a cell.
bool PlanRaster::isClear(const Point& from, const Point& to, bool large_only) const {
  if (empty()) return true;
  const Point span = to - from;
  const double size = length(span);
  const int count = static_cast<int>(std::min(4096.0, size / (0.5 * cell_))) + 1;
  const std::uint8_t limit = large_only ? 2 : 1;
  for (int i = 1; i <= count; ++i) {
    const Point p = from + (static_cast<double>(i) / count) * span;
    const double c = (p.x - origin_.x) / cell_, r = (p.y - origin_.y) / cell_;
    if (c < 0.0 || r < 0.0 || c >= columns_ || r >= rows_) continue;
    if (blocked_[static_cast<std::size_t>(r) * columns_ + static_cast<std::size_t>(c)] >= limit)
      return false;
  }
  return true;
}

Point PlanRaster::nearestFree(const Point& place) const {
  if (empty()) return place;
  const std::uint32_t own = cellAt(place);
  if (!isBlocked(own)) return place;
  const auto width = static_cast<std::uint32_t>(columns_);
  const int c0 = static_cast<int>(own % width), r0 = static_cast<int>(own / width);
  const int reach = static_cast<int>(SEARCH / cell_) + 1;
  Point out = place;
  double best = std::numeric_limits<double>::infinity();
  for (int r = std::max(0, r0 - reach); r <= std::min(rows_ - 1, r0 + reach); ++r)
    for (int c = std::max(0, c0 - reach); c <= std::min(columns_ - 1, c0 + reach); ++c) {
      const auto cell = static_cast<std::uint32_t>(r) * width + static_cast<std::uint32_t>(c);
      const Point away = centreOf(cell) - place;
      if (isBlocked(cell) || dot(away, away) >= best) continue;
      best = dot(away, away);
      out = centreOf(cell);
    }
  return out;
}

}  // namespace vegetation_sim::crowd
