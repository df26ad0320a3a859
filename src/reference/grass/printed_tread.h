// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// Returns treadField() for eps = 0 as paper 2, section 4.2 prints it. The sines of the formula
/// cancel near the extension of the segment.
double treadFieldPrinted(const Point& p, const Point& p0, const Point& p1);

}  // namespace vegetation_sim::grass
