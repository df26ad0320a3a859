// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/tread_field.h"

#include <cmath>

namespace vegetation_sim::grass {

double treadField(const Point& p, const Point& p0, const Point& p1, double eps) {
  const double c = distanceBetween(p0, p1);
  if (!(c > 0.0)) return 0.0;
  const double tx = (p1.x - p0.x) / c, ty = (p1.y - p0.y) / c;
  const double ax = p0.x - p.x, ay = p0.y - p.y;
  const double s0 = ax * tx + ay * ty, d = ax * ty - ay * tx;
  const double s1 = s0 + c, square = d * d + eps * eps;
  return kernelIntegral({s0, std::sqrt(square + s0 * s0)}, {s1, std::sqrt(square + s1 * s1)},
                        square);
}

Point treadVector(const Point& p, const Point& p0, const Point& p1, double field) {
  const double c = distanceBetween(p0, p1);
  if (!(c > SHORTEST_STROKE)) return {};
  const double tx = (p1.x - p0.x) / c, ty = (p1.y - p0.y) / c;
  const double side = (p.y - p0.y) * tx - (p.x - p0.x) * ty;
  const double sign = side > NO_SIDE ? 1.0 : side < -NO_SIDE ? -1.0 : 0.0;
  return {field * (tx - sign * ty), field * (ty + sign * tx)};
}

double treadFieldPrinted(const Point& p, const Point& p0, const Point& p1) {
  const double c = distanceBetween(p0, p1);
  if (!(c > 0.0)) return 0.0;
  const double tx = (p1.x - p0.x) / c, ty = (p1.y - p0.y) / c;
  const double along = (p.x - p0.x) * tx + (p.y - p0.y) * ty;
  const Point foot{p0.x + along * tx, p0.y + along * ty};
  const double height = distanceBetween(p, foot);
  const double sine0 = -along / distanceBetween(p, p0),
               sine1 = (c - along) / distanceBetween(p, p1);
  return (sine1 - sine0) / (height * height);
}

}  // namespace vegetation_sim::grass
