// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::grass {

/// A blade in its own plane: distance from the root along the bend, height above the ground.
template <class T>
struct Profile {
  std::array<T, POINTS> reach{}, rise{};
};

/// Returns the shape of a blade of length `length` whose root is tilted by `hinge` [rad] from
/// upright and which bends by another `arc` up to its tip. Requires 0 <= hinge, arc and hinge + arc
/// <= BEND_LIMIT; then the tip is never below the root, and for hinge = BEND_LIMIT within 10
/// degrees of the ground.
template <class T>
Profile<T> bladeProfile(T length, T hinge, T arc, BladeModel model);

extern template Profile<float> bladeProfile(float, float, float, BladeModel);
extern template Profile<double> bladeProfile(double, double, double, BladeModel);

/// Point of the paper's Hermite curve at s in [0, 1] from the root, with an upright tangent, to the
/// tip (x, z), with the tangent 2 tip - up.
template <class T>
struct PlanePoint {
  T reach, rise;
};
PlanePoint<double> hermitePoint(double length, double tip_x, double tip_z, double s);

/// Returns the paper's lowered ordinate sqrt(length^2 - x^2).
double loweredTip(double length, double tip_x);

}  // namespace vegetation_sim::grass
