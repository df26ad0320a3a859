// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/trajectory.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::wind {

Trajectory::Trajectory(const std::vector<Waypoint>& points)
    : points_(points), bend_(points.size(), Vec3::Zero()) {
  if (points_.size() > 2) solve();
}

double Trajectory::step(std::size_t i) const {
  return secondsBetween(points_[i].stamp, points_[i + 1].stamp);
}

Vec3 Trajectory::chord(std::size_t i) const {
  return (points_[i + 1].position - points_[i].position) / step(i);
}

// Solves the tridiagonal system of the second derivatives, which are zero at the ends, by the
// Thomas algorithm.
void Trajectory::solve() {
  const std::size_t last = points_.size() - 1;
  std::vector<double> ratio(points_.size(), 0.0);
  for (std::size_t i = 1; i < last; ++i) {
    const double before = step(i - 1), after = step(i);
    const double pivot = 2.0 * (before + after) - before * ratio[i - 1];
    ratio[i] = after / pivot;
    bend_[i] = (6.0 * (chord(i) - chord(i - 1)) - before * bend_[i - 1]) / pivot;
  }
  for (std::size_t i = last - 1; i > 0; --i) bend_[i] -= ratio[i] * bend_[i + 1];
}

Vec3 Trajectory::slopeAtStart(std::size_t i) const {
  return chord(i) - step(i) * (2.0 * bend_[i] + bend_[i + 1]) / 6.0;
}

Vec3 Trajectory::slopeAtEnd(std::size_t i) const {
  return chord(i) + step(i) * (bend_[i] + 2.0 * bend_[i + 1]) / 6.0;
}

// The acceleration is linear between way points.
double Trajectory::accelerationBound(Nanoseconds from, Nanoseconds to) const {
  double square = 0.0;
  const auto after =
      std::upper_bound(points_.begin(), points_.end(), from,
                       [](Nanoseconds t, const Waypoint& point) { return t < point.stamp; });
  auto i = static_cast<std::size_t>(after - points_.begin());
  for (i -= i > 0 ? 1 : 0; i < points_.size(); ++i) {
    square = std::max(square, bend_[i].x() * bend_[i].x() + bend_[i].y() * bend_[i].y());
    if (points_[i].stamp >= to) break;
  }
  return std::sqrt(square);
}

Vec3 Trajectory::at(Nanoseconds stamp) const {
  if (points_.empty()) return Vec3::Zero();
  const Waypoint &first = points_.front(), &last = points_.back();
  if (points_.size() == 1) return first.position;
  if (stamp <= first.stamp)
    return first.position + slopeAtStart(0) * secondsBetween(first.stamp, stamp);
  if (stamp >= last.stamp)
    return last.position + slopeAtEnd(points_.size() - 2) * secondsBetween(last.stamp, stamp);
  const auto next =
      std::upper_bound(points_.begin(), points_.end(), stamp,
                       [](Nanoseconds t, const Waypoint& point) { return t < point.stamp; });
  const auto i = static_cast<std::size_t>(next - points_.begin()) - 1;
  const double dt = secondsBetween(points_[i].stamp, stamp);
  const Vec3 cubic = (bend_[i + 1] - bend_[i]) / (6.0 * step(i));
  return points_[i].position + dt * (slopeAtStart(i) + dt * (0.5 * bend_[i] + dt * cubic));
}

}  // namespace vegetation_sim::wind
