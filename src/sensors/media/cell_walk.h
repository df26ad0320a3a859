// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sensors/geometry/box.h"
#include "sensors/geometry/ray.h"
#include "sensors/media/beer_lambert.h"

namespace vegetation_sim::scan {

/// Steps a ray through a grid of cells.
class CellWalk {
 public:
  /// @param size edge of the cells across, @param rise their height [m].
  CellWalk(const Ray& ray, double from, double size, double rise)
      : cell_(cellAt(ray.at(from), size)) {
    const Vec3 place = ray.at(from);
    cell_.z = cellAt(place, rise).z;
    const std::int32_t index[3] = {cell_.x, cell_.y, cell_.z};
    for (int i = 0; i < 3; ++i) {
      if (i == 2) size = rise;
      step_[i] = std::fabs(size * ray.inverse[i]);
      const double edge = size * (index[i] + (ray.direction[i] > 0.0 ? 1 : 0));
      next_[i] = ray.direction[i] == 0.0 ? Box::ENDLESS : from + (edge - place[i]) * ray.inverse[i];
      way_[i] = ray.direction[i] > 0.0 ? 1 : -1;
    }
  }
  const Cell& cell() const { return cell_; }
  /// Returns the distance at which the ray leaves the cell.
  double end() const { return std::min({next_[0], next_[1], next_[2]}); }
  void advance() {
    const int axis =
        next_[0] <= next_[1] ? (next_[0] <= next_[2] ? 0 : 2) : (next_[1] <= next_[2] ? 1 : 2);
    next_[axis] += step_[axis];
    (axis == 0 ? cell_.x : axis == 1 ? cell_.y : cell_.z) += way_[axis];
  }

 private:
  Cell cell_;
  double next_[3], step_[3];
  std::int32_t way_[3];
};

/// Steps a ray through upright columns.
class ColumnWalk {
 public:
  /// @param ray must outlive the walk. @param size edge of a column, @param rise of a step [m].
  /// @param key of the random numbers.
  ColumnWalk(const Ray& ray, double size, double rise, std::uint32_t key)
      : ray_(ray), size_(size), rise_(rise), key_(key) {}

  /// Begins at a distance, unless the ray is within the columns already.
  void enter(double from) {
    if (walk_) return;
    walk_.emplace(ray_, from, size_, rise_);
    at_ = from;
    column_ = {INT32_MIN, 0, 0};
  }
  void leave() { walk_.reset(); }

  struct Step {
    double from, to;
    double length() const { return to - from; }
  };
  /// Takes a step, at most up to a distance.
  Step next(double most) {
    const Cell& cell = walk_->cell();
    if (cell.x != column_.x || cell.y != column_.y) {
      column_ = {cell.x, cell.y, 0};
      share_ = shareOf(column_, key_);
      spent_ = 0.0;
    }
    const double from = at_;
    at_ = std::min(walk_->end(), most);
    walk_->advance();
    return {from, at_};
  }
  const Ray& ray() const { return ray_; }
  double at() const { return at_; }  ///< distance [m]
  /// Random number of the column of the last step, and the optical depth that the ray has met in
  /// it.
  double share() const { return share_; }
  double spent() const { return spent_; }
  void spend(double depth) { spent_ += depth; }

 private:
  const Ray& ray_;
  double size_, rise_;
  std::uint32_t key_;
  std::optional<CellWalk> walk_;
  Cell column_;
  double at_{0.0}, share_{0.0}, spent_{0.0};
};

}  // namespace vegetation_sim::scan
