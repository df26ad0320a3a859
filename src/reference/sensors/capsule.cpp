// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/capsule.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::scan {
namespace {

constexpr double PARALLEL = 1e-9;  // squared sine below which a ray does not meet the side

Stretch inBall(const Ray& ray, const Vec3& centre, double radius) {
  const Vec3 offset = ray.origin - centre;
  const double b = dot(offset, ray.direction);
  const double square = b * b - dot(offset, offset) + radius * radius;
  if (!(square > 0.0)) return {};
  return {-b - std::sqrt(square), -b + std::sqrt(square)};
}

Stretch inCylinder(const Ray& ray, const Rod& rod, double radius) {
  const Vec3 offset = ray.origin - rod.base;
  const double da = dot(ray.direction, rod.axis), oa = dot(offset, rod.axis);
  const double a = 1.0 - da * da, b = dot(offset, ray.direction) - oa * da;
  const double square = b * b - a * (dot(offset, offset) - oa * oa - radius * radius);
  if (a < PARALLEL || !(square > 0.0)) return {};
  const Stretch out{(-b - std::sqrt(square)) / a, (-b + std::sqrt(square)) / a};
  if (da == 0.0) return oa >= 0.0 && oa <= rod.length ? out : Stretch{};
  const double base = -oa / da, tip = (rod.length - oa) / da;
  return {std::max(out.from, std::min(base, tip)), std::min(out.to, std::max(base, tip))};
}

}  // namespace

Stretch withinPlainly(const Ray& ray, const Rod& rod, double radius) {
  Stretch all;
  for (const Stretch& part : {inCylinder(ray, rod, radius), inBall(ray, rod.base, radius),
                              inBall(ray, rod.base + rod.length * rod.axis, radius)}) {
    if (!(part.from < part.to)) continue;
    const bool first = !(all.from < all.to);
    all.from = first ? part.from : std::min(all.from, part.from);
    all.to = first ? part.to : std::max(all.to, part.to);
  }
  all.from = std::max(all.from, 0.0);
  return all;
}

}  // namespace vegetation_sim::scan
