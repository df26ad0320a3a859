// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/obstacle.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double NEVER = std::numeric_limits<double>::infinity();

Vec3 flat(const Point& p) {
  return {p.x, p.y, 0.0};
}

Point inFrame(const Box& box, const Point& v) {
  return {box.axes[0].x() * v.x + box.axes[0].y() * v.y,
          box.axes[1].x() * v.x + box.axes[1].y() * v.y};
}

Point fromFrame(const Box& box, const Point& v) {
  return {box.axes[0].x() * v.x + box.axes[1].x() * v.y,
          box.axes[0].y() * v.x + box.axes[1].y() * v.y};
}

// Returns the interval of time in which one coordinate is within `half` of 0.
void slab(double at, double speed, double half, double& enter, double& leave) {
  if (speed == 0.0) {
    if (std::fabs(at) >= half) leave = -NEVER;
    return;
  }
  const double a = (-half - at) / speed, b = (half - at) / speed;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

}  // namespace

Obstacle discObstacle(const Point& centre, double radius) {
  Obstacle out;
  out.box = ballAt(flat(centre), radius);
  out.reach = radius;
  return out;
}

Obstacle boxObstacle(const Point& centre, double half_x, double half_y, double yaw) {
  Obstacle out;
  out.box = uprightBox(flat(centre), Vec3(half_x, half_y, 0.0), yaw);
  out.reach = std::sqrt(half_x * half_x + half_y * half_y);
  return out;
}

Obstacle wallObstacle(const Point& from, const Point& to, double thickness) {
  const Point span = to - from;
  return boxObstacle(0.5 * (from + to), 0.5 * length(span), 0.5 * thickness,
                     arcTangent(span.y, span.x));
}

Obstacle outlineObstacle(const std::vector<Point>& corners, const Point& centre, double yaw) {
  Point low = corners.front(), high = low;
  for (const Point& c : corners) {
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  }
  const SinCos turn = sinCos(yaw);
  const auto place = [&](const Point& c) {
    return Point{centre.x + turn.cos * c.x - turn.sin * c.y,
                 centre.y + turn.sin * c.x + turn.cos * c.y};
  };
  Obstacle out =
      boxObstacle(place(0.5 * (low + high)), 0.5 * (high.x - low.x), 0.5 * (high.y - low.y), yaw);
  for (const Point& c : corners) out.hull.points.push_back(flat(place(c)));
  return out;
}

Separation separation(const Point& centre, double radius, const Obstacle& obstacle, double enough) {
  if (!obstacle.hull.points.empty())
    return separation(ballAt(flat(centre), radius), obstacle.hull, enough);
  if (!obstacle.isDisc()) return separation(ballAt(flat(centre), radius), obstacle.box, enough);
  const Point to = obstacle.centre() - centre;
  const double apart = length(to);
  Separation out;
  out.gap = apart - radius - obstacle.box.radius;
  out.lower = out.upper = std::max(0.0, out.gap);
  out.overlapping = !(out.gap > 0.0);
  out.cores_overlap = !(apart > 0.0);
  if (apart > 0.0) out.normal = flat((1.0 / apart) * to);
  return out;
}

Point wayOut(const Point& point, const Obstacle& obstacle) {
  const Box& box = obstacle.box;
  const Point at = inFrame(box, point - obstacle.centre());
  const double x = box.half.x() - std::fabs(at.x), y = box.half.y() - std::fabs(at.y);
  if (x < y) return fromFrame(box, {at.x < 0.0 ? -x : x, 0.0});
  return fromFrame(box, {0.0, at.y < 0.0 ? -y : y});
}

double timeToMeet(const Point& from, double radius, const Point& velocity,
                  const Obstacle& obstacle) {
  const Point to = obstacle.centre() - from;
  if (obstacle.isDisc()) return timeToMeet(to, radius + obstacle.box.radius, velocity);
  const Box& box = obstacle.box;
  const Point at = inFrame(box, Point{-to.x, -to.y}), speed = inFrame(box, velocity);
  double enter = -NEVER, leave = NEVER;
  slab(at.x, speed.x, box.half.x() + radius, enter, leave);
  slab(at.y, speed.y, box.half.y() + radius, enter, leave);
  if (!(leave > enter) || leave <= 0.0) return NEVER;
  if (enter > 0.0) return enter;
  // Within the margin of the box, only a velocity further into it meets it.
  return dot(to, velocity) > 0.0 ? 0.0 : NEVER;
}

}  // namespace vegetation_sim::crowd
