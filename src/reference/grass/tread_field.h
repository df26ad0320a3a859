// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// Returns the convolution field of the segment p0-p1 at p for the kernel (r^2 + eps^2)^(-3/2)
/// [1/m^2]: paper 2, section 4.2, in the signed form that does not cancel (E5). It is 0 for a
/// segment without length, and infinite on the segment if eps = 0.
double treadField(const Point& p, const Point& p0, const Point& p1, double eps);

/// Returns treadField() for eps = 0 as paper 2, section 4.2 prints it. The sines of the formula
/// cancel near the extension of the segment.
double treadFieldPrinted(const Point& p, const Point& p0, const Point& p1);

/// Returns the crushing vector E(P) = F (sign(A.N) N + C) of paper 2, which is F C on the track.
Point treadVector(const Point& p, const Point& p0, const Point& p1, double field);

}  // namespace vegetation_sim::grass
