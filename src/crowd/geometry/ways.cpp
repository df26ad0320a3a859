// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/ways.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::crowd {
namespace {

constexpr std::uint32_t STRAIGHT = 5, DIAGONAL = 7;           // cost in fifths of a cell
constexpr int LOOK_AHEAD = 32;                                // limit in cells along the way
constexpr std::size_t MOST_FIELDS = 32;                       // cached beyond those in use
constexpr std::uint64_t IN_USE = 119;                         // ticks
constexpr std::size_t MOST_WAY_CELLS = std::size_t{1} << 25;  // cells of all fields, 128 MB

struct Step {
  int column, row;
  std::uint32_t cost;
};
constexpr Step STEPS[8] = {{1, 0, STRAIGHT},   {0, 1, STRAIGHT}, {-1, 0, STRAIGHT},
                           {0, -1, STRAIGHT},  {1, 1, DIAGONAL}, {-1, 1, DIAGONAL},
                           {-1, -1, DIAGONAL}, {1, -1, DIAGONAL}};

// Calls `each(cell, cost)` for the free neighbours; diagonal steps do not cut blocked corners.
template <class Each>
void visitNeighbours(const PlanRaster& raster, std::uint32_t cell, Each each) {
  const int width = raster.columns();
  const int column = static_cast<int>(cell) % width, row = static_cast<int>(cell) / width;
  for (const Step& step : STEPS) {
    const int c = column + step.column, r = row + step.row;
    if (c < 0 || r < 0 || c >= width || r >= raster.rows()) continue;
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * width + x); };
    if (raster.isBlocked(at(c, r))) continue;
    if (step.cost == DIAGONAL && (raster.isBlocked(at(c, row)) || raster.isBlocked(at(column, r))))
      continue;
    each(at(c, r), step.cost);
  }
}

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

// Costs are small integers, so that waiting cells are sorted into eight buckets in turn.
FlowField::FlowField(const PlanRaster& raster, std::uint32_t cell) {
  length_.assign(static_cast<std::size_t>(raster.columns()) * raster.rows(), FAR);
  constexpr std::uint32_t BUCKETS = DIAGONAL + 1;
  std::vector<std::uint32_t> buckets[BUCKETS];
  length_[cell] = 0;
  buckets[0].push_back(cell);
  std::size_t waiting = 1;
  std::vector<std::uint32_t> now;
  for (std::uint32_t length = 0; waiting > 0; ++length) {
    now.swap(buckets[length % BUCKETS]);
    waiting -= now.size();
    for (const std::uint32_t at : now) {
      if (length_[at] != length) continue;  // a shorter way was found since
      visitNeighbours(raster, at, [&](std::uint32_t next, std::uint32_t cost) {
        if (length + cost >= length_[next]) return;
        length_[next] = length + cost;
        buckets[(length + cost) % BUCKETS].push_back(next);
        ++waiting;
      });
    }
    now.clear();
  }
}

std::uint32_t FlowField::next(const PlanRaster& raster, std::uint32_t cell) const {
  std::uint32_t out = cell;
  visitNeighbours(raster, cell, [&](std::uint32_t at, std::uint32_t) {
    if (length_[at] < length_[out]) out = at;
  });
  return out;
}

bool FlowField::isReachable(const PlanRaster& raster, const Point& from) const {
  return length_[raster.cellAt(raster.nearestFree(from))] != FAR;
}

bool FlowField::aimFrom(const PlanRaster& raster, const Point& from, const Point& goal,
                        Point& aim) const {
  aim = goal;
  if (raster.isClear(from, goal, false)) return true;
  const Point start = raster.nearestFree(from);
  std::uint32_t cell = raster.cellAt(start);
  if (length_[cell] == FAR) return false;
  std::uint32_t path[LOOK_AHEAD];
  for (std::uint32_t& at : path) at = cell = next(raster, cell);
  for (int i = LOOK_AHEAD - 1; i > 0; i = i * 2 / 3)
    if (raster.isClear(start, raster.centreOf(path[i]), false)) {
      aim = raster.centreOf(path[i]);
      return true;
    }
  aim = raster.centreOf(path[0]);
  return true;
}

void Ways::setObstacles(const ObstacleGrid& still, double clearance, double cell) {
  raster_ = PlanRaster(still, clearance, cell);
  fields_.clear();
}

const FlowField& Ways::fieldOf(const Point& goal) {
  const std::uint32_t cell = freeCell(goal);
  Kept& kept = fields_[cell];
  if (!kept.field) kept.field = std::make_unique<FlowField>(raster_, cell);
  kept.asked = tick_;
  return *kept.field;
}

bool Ways::isReachable(const Point& from, const Point& goal) const {
  const std::uint32_t cell = freeCell(goal);
  const auto found = fields_.find(cell);
  if (found != fields_.end()) return found->second.field->isReachable(raster_, from);
  return FlowField(raster_, cell).isReachable(raster_, from);
}

void Ways::endTick() {
  ++tick_;
  while (fields_.size() > MOST_FIELDS) {
    auto oldest = fields_.begin();
    for (auto i = fields_.begin(); i != fields_.end(); ++i)
      if (i->second.asked < oldest->second.asked) oldest = i;
    const std::size_t cells = static_cast<std::size_t>(raster_.columns()) * raster_.rows();
    const std::uint64_t kept = fields_.size() * cells > MOST_WAY_CELLS ? 1 : IN_USE;
    if (oldest->second.asked + kept >= tick_) return;
    fields_.erase(oldest);
  }
}

}  // namespace vegetation_sim::crowd
