// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/rod.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::scan {
namespace {

constexpr double ALONG = 1e-9;  // squared sine below which a ray can only meet an end of a rod

// Returns the interval of a ray's line in a ball; empty if it misses.
Stretch through(const Ray& ray, const Vec3& centre, double radius) {
  const Vec3 offset = ray.origin - centre;
  const double b = dot(offset, ray.direction);
  const double square = b * b - dot(offset, offset) + radius * radius;
  if (!(square > 0.0)) return {};
  const double root = std::sqrt(square);
  return {-b - root, -b + root};
}

void improve(double distance, const Vec3& normal, const Ray& ray, Meeting& out) {
  if (!(distance >= 0.0 && distance < out.distance)) return;
  out.distance = distance;
  out.cosine = std::fabs(dot(normal, ray.direction));
}

void meetBall(const Ray& ray, const Vec3& centre, double radius, Meeting& out) {
  const Stretch part = through(ray, centre, radius);
  if (part.from < part.to && part.from < out.distance)
    improve(part.from, (ray.at(part.from) - centre) / radius, ray, out);
}

// Distance from the end of a cylinder from which on rounding cannot make the interval of the ball
// there the longer one, nor that end cut anything off [m].
constexpr double BEYOND_BALL = 1e-3;

// Which balls at the ends of a cylinder may extend the interval of a ray.
struct Balls {
  bool base{true}, tip{true};
};

// Returns the interval of a ray's line in a cylinder around the axis, cut off at both ends.
Stretch throughCylinder(const Ray& ray, const Rod& rod, double radius, Balls& balls) {
  const Vec3 offset = ray.origin - rod.base;
  const double da = dot(ray.direction, rod.axis), oa = dot(offset, rod.axis);
  const double a = 1.0 - da * da, b = dot(offset, ray.direction) - oa * da;
  const double square = b * b - a * (dot(offset, offset) - oa * oa - radius * radius);
  if (a < ALONG || !(square > 0.0)) return {};
  const double root = std::sqrt(square);
  Stretch out{(-b - root) / a, (-b + root) / a};
  const double enters = oa + da * out.from, leaves = oa + da * out.to;
  balls.base = std::min(enters, leaves) < BEYOND_BALL;
  balls.tip = std::max(enters, leaves) > rod.length - BEYOND_BALL;
  if (!balls.base && !balls.tip) return out;  // the ends cut nothing off
  if (da == 0.0) return oa >= 0.0 && oa <= rod.length ? out : Stretch{};
  const double low = -oa / da, high = (rod.length - oa) / da;
  return {std::max(out.from, std::min(low, high)), std::min(out.to, std::max(low, high))};
}

}  // namespace

Rod rodBetween(const Vec3& base, const Vec3& tip, double base_radius, double tip_radius) {
  const Vec3 way = tip - base;
  const double size = length(way);
  Rod out;
  out.base = base;
  if (size > 0.0) out.axis = way / size;
  out.length = size;
  out.base_radius = base_radius;
  out.tip_radius = tip_radius;
  return out;
}

Box boxOf(const Rod& rod) {
  Box out;
  out.add(rod.base, rod.base_radius);
  out.add(rod.base + rod.length * rod.axis, rod.tip_radius);
  return out;
}

// For a point at height y along the axis of a cone with radius r(y) = r0 + k y: |x|^2 - y^2 =
// r(y)^2.
bool meet(const Ray& ray, const Rod& rod, double reach, Meeting& out) {
  const Vec3 offset = ray.origin - rod.base;
  const double slope = rod.length > 0.0 ? (rod.tip_radius - rod.base_radius) / rod.length : 0.0;
  const double r0 = rod.base_radius, more = 1.0 + slope * slope;
  const double da = dot(ray.direction, rod.axis), oa = dot(offset, rod.axis);
  const double a = 1.0 - da * da * more;
  const double b = dot(offset, ray.direction) - oa * da * more - slope * r0 * da;
  const double c = dot(offset, offset) - oa * oa * more - 2.0 * slope * r0 * oa - r0 * r0;
  const double square = b * b - a * c;
  out.distance = reach;
  if (a > ALONG && !(square >= 0.0)) return false;  // the balls protrude by slope^2 of their size
  if (square >= 0.0) {
    // This is the entry also if the ray is steeper than the side and never leaves the cone.
    const double distance = c / (std::sqrt(square) - b), along = oa + distance * da;
    if (along >= 0.0 && along <= rod.length) {
      const Vec3 across = ray.at(distance) - rod.base - along * rod.axis;
      improve(distance, (across / (r0 + slope * along) - slope * rod.axis) / std::sqrt(more), ray,
              out);
      return out.distance < reach;
    }
  }
  meetBall(ray, rod.base, r0, out);
  meetBall(ray, rod.base + rod.length * rod.axis, rod.tip_radius, out);
  return out.distance < reach;
}

Stretch within(const Ray& ray, const Rod& rod, double radius) {
  Balls balls;
  Stretch all = throughCylinder(ray, rod, radius, balls);
  if (!(all.from < all.to)) all = {};
  const auto extend = [&](const Stretch& part) {
    if (!(part.from < part.to)) return;
    const bool first = !(all.from < all.to);
    all.from = first ? part.from : std::min(all.from, part.from);
    all.to = first ? part.to : std::max(all.to, part.to);
  };
  if (balls.base) extend(through(ray, rod.base, radius));
  if (balls.tip) extend(through(ray, rod.base + rod.length * rod.axis, radius));
  all.from = std::max(all.from, 0.0);
  return all;
}

}  // namespace vegetation_sim::scan
