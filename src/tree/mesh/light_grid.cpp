// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/light_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr double EXTINCTION = 0.4;  // leaves of all orientations that transmit some light
constexpr double LOWEST_SUN =
    0.1;  // vertical part of a unit direction; below, shadows leave the grid

std::size_t cellsOf(double extent, double cell) {
  return static_cast<std::size_t>(std::ceil(extent / cell)) + 1;
}

// Two neighbouring cells on one axis and the weight of the second, held inside the grid.
struct Between {
  std::size_t first, second;
  double weight;
};

Between interpolate(double x, std::size_t cells) {
  const double held = std::clamp(x, 0.0, static_cast<double>(cells - 1));
  const auto first = static_cast<std::size_t>(held);
  return {first, std::min(first + 1, cells - 1), held - static_cast<double>(first)};
}

double mix(double a, double b, double weight) {
  return a + (b - a) * weight;
}

}  // namespace

LightGrid::LightGrid(const Vec3& low, const Vec3& high, double cell) : low_(low), cell_(cell) {
  const Vec3 extent = high - low;
  if (!(extent.minCoeff() > 0.0) || !(cell > 0.0) || !extent.allFinite())
    throw std::invalid_argument("LightGrid: the box or the cell is empty");
  const double volume = extent.x() * extent.y() * extent.z();
  cell_ = std::max(cell_, cubeRoot(1.2 * volume / static_cast<double>(MOST_CELLS)));
  // A thin box has more cells than its volume says.
  const auto count = [&] { return ((extent / cell_).array().ceil() + 1.0).prod(); };
  while (count() > static_cast<double>(MOST_CELLS)) cell_ *= 1.2;
  columns_ = cellsOf(extent.x(), cell_);
  rows_ = cellsOf(extent.y(), cell_);
  layers_ = cellsOf(extent.z(), cell_);
  leaf_.assign(columns_ * rows_ * layers_, 0.f);
}

void LightGrid::addLeaf(const Vec3& point, double area) {
  const Vec3 at = (point - low_) / cell_;
  if (!(at.minCoeff() >= 0.0)) return;
  const Vec3 nearest = at + Vec3::Constant(0.5);
  const auto x = static_cast<std::size_t>(nearest.x()), y = static_cast<std::size_t>(nearest.y()),
             z = static_cast<std::size_t>(nearest.z());
  if (x >= columns_ || y >= rows_ || z >= layers_) return;
  leaf_[index(x, y, z)] += static_cast<float>(area);
}

void LightGrid::sweep(const Vec3& direction, std::vector<float>& out) const {
  out.assign(leaf_.size(), 1.f);
  const double dx = direction.x() / direction.z(), dy = direction.y() / direction.z();
  const double way = std::sqrt(dx * dx + dy * dy + 1.0);    // path through a layer [cells]
  const double depth = EXTINCTION * way / (cell_ * cell_);  // optical depth per leaf area
  for (std::size_t z = layers_ - 1; z-- > 0;) {
    for (std::size_t y = 0; y < rows_; ++y) {
      const double up_y = static_cast<double>(y) + dy;
      for (std::size_t x = 0; x < columns_; ++x) {
        const double up_x = static_cast<double>(x) + dx;
        const Between i = interpolate(up_x, columns_), j = interpolate(up_y, rows_);
        const auto above = [&](const std::vector<float>& grid) {
          const float* layer = grid.data() + (z + 1) * rows_ * columns_;
          const float *a = layer + j.first * columns_, *b = layer + j.second * columns_;
          return mix(mix(a[i.first], a[i.second], i.weight), mix(b[i.first], b[i.second], i.weight),
                     j.weight);
        };
        const double blocked = depth * above(leaf_);
        out[index(x, y, z)] =
            static_cast<float>(above(out) / (1.0 + blocked + 0.5 * blocked * blocked));
      }
    }
  }
}

void LightGrid::cast(const Vec3& to_sun) {
  Vec3 direction = to_sun / std::max(length(to_sun), 1e-9);
  direction.z() = std::max(direction.z(), LOWEST_SUN);
  sweep(direction, sun_);
  // The sky is its zenith and four points at half height, weighted by their elevation.
  const std::array<Vec3, 5> points{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(-1, 0, 1), Vec3(0, 1, 1),
                                   Vec3(0, -1, 1)};
  sky_.assign(leaf_.size(), 0.f);
  std::vector<float> part;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sweep(points[i], part);
    const float weight = i == 0 ? 0.28f : 0.18f;
    for (std::size_t c = 0; c < part.size(); ++c) sky_[c] += weight * part[c];
  }
}

double LightGrid::sample(const std::vector<float>& grid, const Vec3& point) const {
  if (grid.empty() || !point.allFinite()) return 1.0;
  const Vec3 at = (point - low_) / cell_;
  const Between i = interpolate(at.x(), columns_), j = interpolate(at.y(), rows_),
                k = interpolate(at.z(), layers_);
  const auto get = [&](std::size_t x, std::size_t y, std::size_t z) {
    return static_cast<double>(grid[index(x, y, z)]);
  };
  const auto layer = [&](std::size_t z) {
    return mix(mix(get(i.first, j.first, z), get(i.second, j.first, z), i.weight),
               mix(get(i.first, j.second, z), get(i.second, j.second, z), i.weight), j.weight);
  };
  return mix(layer(k.first), layer(k.second), k.weight);
}

}  // namespace vegetation_sim::forest
