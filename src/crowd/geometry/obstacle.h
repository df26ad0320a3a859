// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "crowd/geometry/convex.h"

namespace vegetation_sim::crowd {

/// A place or direction on the plan [m]. Point() is the origin; `Point p;` is uninitialised, since
/// views are made for each walker and mostly stay unused.
struct Point {
  double x, y;
};
inline Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator*(double s, const Point& a) {
  return {s * a.x, s * a.y};
}
// Overloads for vectors and points.
using vegetation_sim::dot;
using vegetation_sim::length;

inline double dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y;
}
inline double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

/// A static or moving obstacle, seen from above. People, trunks, walls and robots are upright, so
/// their outlines on the plan suffice.
struct Obstacle {
  Box box;            ///< flat box that contains the outline, or is the outline
  Hull hull;          ///< flat hull; if it has no points, the box is the outline
  Point velocity{};   ///< [m/s]
  double reach{0.0};  ///< radius of a circle about the box' centre that contains the outline [m]

  bool isDisc() const { return box.half.x() == 0.0 && box.half.y() == 0.0; }
  Point centre() const { return {box.centre.x(), box.centre.y()}; }
};

Obstacle discObstacle(const Point& centre, double radius);
/// Makes the bounding box of a trunk, turned by `yaw` [rad].
Obstacle boxObstacle(const Point& centre, double half_x, double half_y, double yaw);
Obstacle wallObstacle(const Point& from, const Point& to, double thickness);
/// Makes the convex hull of corners that are given in a frame at `centre`, turned by `yaw`.
Obstacle outlineObstacle(const std::vector<Point>& corners, const Point& centre, double yaw);

/// Returns the distance of a disc's edge from an obstacle; the normal points from the disc to it.
Separation separation(const Point& centre, double radius, const Obstacle& obstacle,
                      double enough = std::numeric_limits<double>::infinity());

/// Returns the shortest move [m] to the outline of an obstacle whose core contains the point.
Point wayOut(const Point& point, const Obstacle& obstacle);

/// Returns the time until a disc at `from` with `velocity` relative to the obstacle meets its box
/// [s]; infinity if never. For boxes it is slightly early at corners.
double timeToMeet(const Point& from, double radius, const Point& velocity,
                  const Obstacle& obstacle);
/// Returns the same for a point and a disc whose centre is at `to` from it.
inline double timeToMeet(const Point& to, double radius, const Point& velocity) {
  constexpr double NEVER = std::numeric_limits<double>::infinity();
  const double closing = dot(to, velocity), away = dot(to, to) - radius * radius;
  if (!(closing > 0.0)) return NEVER;
  if (away <= 0.0) return 0.0;
  const double root = closing * closing - dot(velocity, velocity) * away;
  return root < 0.0 ? NEVER : away / (closing + std::sqrt(root));
}

}  // namespace vegetation_sim::crowd
