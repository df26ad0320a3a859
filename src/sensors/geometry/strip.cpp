// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/strip.h"

#include <cmath>

namespace vegetation_sim::scan {
namespace {

// Intersects a ray with the triangle a, a + u, a + v (Moeller and Trumbore 1997).
bool meetTriangle(const Ray& ray, const Vec3& a, const Vec3& u, const Vec3& v, Meeting& out) {
  const Vec3 across = cross(ray.direction, v);
  const double determinant = dot(u, across);
  if (determinant == 0.0) return false;
  const double scale = 1.0 / determinant;
  const Vec3 offset = ray.origin - a;
  const double p = scale * dot(offset, across);
  if (!(p >= 0.0 && p <= 1.0)) return false;
  const Vec3 upright = cross(offset, u);
  const double q = scale * dot(ray.direction, upright);
  if (!(q >= 0.0 && p + q <= 1.0)) return false;
  const double distance = scale * dot(v, upright);
  if (!(distance >= 0.0 && distance < out.distance)) return false;
  out.distance = distance;
  out.cosine = std::fabs(determinant) / length(cross(u, v));
  return true;
}

}  // namespace

Box boxOf(const Strip& strip) {
  Box out;
  for (const Vec3& corner : {Vec3(strip.root - strip.low), Vec3(strip.root + strip.low),
                             Vec3(strip.tip - strip.high), Vec3(strip.tip + strip.high)})
    out.add(corner, 0.0);
  return out;
}

bool meet(const Ray& ray, const Strip& strip, double reach, Meeting& out) {
  out.distance = reach;
  const Vec3 from = strip.root - strip.low, opposite = strip.tip + strip.high - from;
  const bool first = meetTriangle(ray, from, 2.0 * strip.low, opposite, out);
  const bool second = meetTriangle(ray, from, opposite, strip.tip - strip.high - from, out);
  return first || second;
}

}  // namespace vegetation_sim::scan
