// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// Smallest and largest coordinates of an area [m].
struct AreaBounds {
  Point low, high;
};
/// Requires a point.
AreaBounds boundsOf(const std::vector<Point>& outline, double radius);

/// Returns the parts of a line of constant y that are inside of an outline (even-odd rule) or
/// within `radius` of it, as ranges of x that rise and do not overlap.
std::vector<std::pair<double, double>> rangesAt(double y, const std::vector<Point>& outline,
                                                double radius);

}  // namespace vegetation_sim::grass
