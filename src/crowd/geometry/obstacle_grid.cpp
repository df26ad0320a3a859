// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/obstacle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_OBSTACLE_CELLS = 1e6;
constexpr double MOST_SPOTS = 2e6;  // 80 MB; long diagonal walls cover very many cells
constexpr double FEW_SPOTS = 9.0;   // limit per obstacle; small ones need fewer

std::vector<Extent> extentsOf(const std::vector<Obstacle>& obstacles) {
  std::vector<Extent> out;
  out.reserve(obstacles.size());
  for (const Obstacle& o : obstacles) out.push_back(extentOf(o));
  return out;
}

double cellsIn(const Point& size, double cell) {
  return (size.x / cell + 1.0) * (size.y / cell + 1.0);
}

// Doubles `wanted` until cells and entries fit the memory.
double affordableCell(const Point& size, const std::vector<Extent>& extents, double wanted) {
  const double most = std::max(MOST_SPOTS, FEW_SPOTS * static_cast<double>(extents.size()));
  const auto spots = [&](double cell) {
    double out = 0.0;
    for (const Extent& e : extents) out += cellsIn(e.high - e.low, cell);
    return out;
  };
  double cell = wanted;
  while (cellsIn(size, cell) > MOST_OBSTACLE_CELLS || spots(cell) > most) cell *= 2.0;
  return cell;
}

}  // namespace

Extent extentOf(const Obstacle& o) {
  const Box& box = o.box;
  double x = box.radius, y = box.radius;
  for (int i = 0; i < 2; ++i) {
    const Vec3& axis = box.axes[static_cast<std::size_t>(i)];
    x += std::fabs(axis.x()) * box.half[i];
    y += std::fabs(axis.y()) * box.half[i];
  }
  const Point c = o.centre();
  return {{c.x - x, c.y - y}, {c.x + x, c.y + y}};
}

ObstacleGrid::ObstacleGrid(std::vector<Obstacle> obstacles, double cell)
    : obstacles_(std::move(obstacles)) {
  if (obstacles_.empty()) return;
  std::vector<Extent> extents = extentsOf(obstacles_);
  Point low = extents.front().low, high = extents.front().high;
  for (const Extent& e : extents) {
    low = {std::min(low.x, e.low.x), std::min(low.y, e.low.y)};
    high = {std::max(high.x, e.high.x), std::max(high.y, e.high.y)};
  }
  origin_ = low;
  const Point size = high - low;
  per_metre_ = 1.0 / affordableCell(size, extents, cell);
  columns_ = static_cast<int>(size.x * per_metre_) + 1;
  rows_ = static_cast<int>(size.y * per_metre_) + 1;
  // Neighbours are near each other in memory, too.
  const auto place = [this](const Extent& e) {
    return std::make_pair(row(e.low.y), column(e.low.x));
  };
  std::stable_sort(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& a, const Obstacle& b) {
    return place(extentOf(a)) < place(extentOf(b));
  });
  extents = extentsOf(obstacles_);
  // Entries are counted, then filled, so that all cells share one vector.
  starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  const auto cover = [&](const Extent& e, auto each) {
    for (int r = row(e.low.y); r <= row(e.high.y); ++r)
      for (int c = column(e.low.x); c <= column(e.high.x); ++c)
        each(static_cast<std::size_t>(r) * columns_ + c, r, c);
  };
  for (const Extent& e : extents) cover(e, [&](std::size_t at, int, int) { ++starts_[at + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  spots_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
    const Obstacle& o = obstacles_[i];
    const int column0 = column(extents[i].low.x), row0 = row(extents[i].low.y);
    cover(extents[i], [&](std::size_t at, int r, int c) {
      spots_[next[at]++] = {o.centre(), o.reach, i, c, o.isDisc(), c == column0, r == row0};
    });
  }
}

}  // namespace vegetation_sim::crowd
