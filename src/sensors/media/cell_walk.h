// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sensors/geometry/box.h"
#include "sensors/geometry/ray.h"
#include "sensors/media/beer_lambert.h"

namespace vegetation_sim::scan {

// Steps have no branches that a processor would have to guess.

/// Steps a ray through a grid of cells.
class CellWalk {
 public:
  /// @param size edge of the cells [m].
  CellWalk(const Ray& ray, double from, double size) : cell_(cellAt(ray.at(from), size)) {
    const Vec3 place = ray.at(from);
    const std::int32_t index[3] = {cell_.x, cell_.y, cell_.z};
    for (int i = 0; i < 3; ++i) {
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
    const bool on_x = next_[0] <= next_[1] && next_[0] <= next_[2];
    const bool on_y = !on_x && next_[1] <= next_[2], on_z = !on_x && !on_y;
    next_[0] += on_x ? step_[0] : 0.0;
    next_[1] += on_y ? step_[1] : 0.0;
    next_[2] += on_z ? step_[2] : 0.0;
    cell_.x += on_x ? way_[0] : 0;
    cell_.y += on_y ? way_[1] : 0;
    cell_.z += on_z ? way_[2] : 0;
  }

 private:
  Cell cell_;
  double next_[3], step_[3];
  std::int32_t way_[3];
};

/// Steps a ray through upright columns. Steps have no branches that a processor would have to
/// guess.
class ColumnWalk {
 public:
  /// @param ray must outlive the walk. @param size edge of a column [m]. @param key of the random
  /// numbers.
  ColumnWalk(const Ray& ray, double size, std::uint32_t key) : ray_(ray), size_(size), key_(key) {}

  /// Begins at a distance, unless the ray is within the columns already.
  void enter(double from) {
    if (std::exchange(inside_, true)) return;
    const Vec3 place = ray_.at(from);
    cell_ = cellAt(place, size_);
    cell_.z = 0;
    x_ = Axis(ray_, 0, from, place.x(), cell_.x, size_);
    y_ = Axis(ray_, 1, from, place.y(), cell_.y, size_);
    at_ = from;
    anew();
  }
  void leave() { inside_ = false; }

  struct Step {
    double from, to;
    double share;  ///< random number of the column
    double spent;  ///< optical depth that the ray has met in the column before
    bool ends;     ///< whether the ray leaves the column
    double length() const { return to - from; }
  };
  /// Goes to the end of the column, or to `most` within it.
  Step next(double most) {
    const bool on_x = x_.next <= y_.next;
    const double end = on_x ? x_.next : y_.next;
    const Step step{at_, std::min(end, most), share_, spent_, end <= most};
    at_ = step.to;
    if (step.ends) {
      x_.next += on_x ? x_.step : 0.0;
      y_.next += on_x ? 0.0 : y_.step;
      cell_.x += on_x ? x_.way : 0;
      cell_.y += on_x ? 0 : y_.way;
      anew();
    }
    return step;
  }
  const Ray& ray() const { return ray_; }
  double at() const { return at_; }  ///< distance [m]
  /// Sets the optical depth that the ray has met in a column which it has not left.
  void setSpent(double depth) { spent_ = depth; }

 private:
  struct Axis {
    Axis() = default;
    Axis(const Ray& ray, int axis, double from, double place, std::int32_t cell, double size)
        : step(std::fabs(size * ray.inverse[axis])), way(ray.direction[axis] > 0.0 ? 1 : -1) {
      const double edge = size * (cell + (way > 0 ? 1 : 0));
      next = ray.direction[axis] == 0.0 ? Box::ENDLESS : from + (edge - place) * ray.inverse[axis];
    }
    double next{0.0}, step{0.0};  ///< distance of the next border, and of one border from another
    std::int32_t way{1};
  };
  void anew() {
    share_ = shareOf(cell_, key_);
    spent_ = 0.0;
  }

  const Ray& ray_;
  double size_;
  std::uint32_t key_;
  bool inside_{false};
  Cell cell_;
  Axis x_, y_;
  double at_{0.0}, share_{0.0}, spent_{0.0};
};

}  // namespace vegetation_sim::scan
