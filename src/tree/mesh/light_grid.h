// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

/// Sunlight and skylight at points among leaves: Beer's law through a coarse grid of leaf area. For
/// display only; an approximation that is smooth on the scale of a cell.
class LightGrid {
 public:
  /// @param low, high corners of the box [m]. @param cell edge [m]; enlarged if the grid would
  /// exceed MOST_CELLS. @throws std::invalid_argument unless low < high and cell > 0.
  LightGrid(const Vec3& low, const Vec3& high, double cell);

  /// Adds `area` [m^2] of leaf at a point; points outside the box are ignored.
  void addLeaf(const Vec3& point, double area);
  /// Computes the light of the sun in direction `to_sun` (upwards) and of the sky.
  void cast(const Vec3& to_sun);

  /// Returns the fraction of sunlight at a point; 1 before cast().
  double sun(const Vec3& point) const { return sample(sun_, point); }
  /// Returns the fraction of skylight at a point; 1 before cast().
  double sky(const Vec3& point) const { return sample(sky_, point); }
  std::size_t cells() const { return leaf_.size(); }

  static constexpr std::size_t MOST_CELLS = 6000000;

 private:
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * rows_ + y) * columns_ + x;
  }
  /// Computes the transmission from `direction` for every cell, from the top layer down.
  void sweep(const Vec3& direction, std::vector<float>& out) const;
  double sample(const std::vector<float>& grid, const Vec3& point) const;

  Vec3 low_;
  double cell_;
  std::size_t columns_{1}, rows_{1}, layers_{1};
  std::vector<float> leaf_, sun_, sky_;  // [layers x rows x columns], lowest layer first
};

}  // namespace vegetation_sim::forest
