// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/printed_tread.h"

namespace vegetation_sim::grass {

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
