// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// A camera that chooses levels of detail: its place and the pixels that a metre takes at one
/// metre.
struct Viewpoint {
  Vec3 position{Vec3::Zero()};
  double pixels_per_radian{1000.0};
  Vec3 forward{Vec3::UnitX()};  ///< unit vector
  double cone_cosine{-1.0};  ///< of half the angle of the visible cone; -1 if all round is visible
};
/// Returns whether any part of a ball is visible.
bool sees(const Viewpoint& viewpoint, const Vec3& centre, double radius);
/// Returns the pixels that one metre takes at `distance` [m], which counts as at least half a
/// metre.
double pixelsPerMetre(const Viewpoint& viewpoint, double distance);

/// A finer level is kept until the error of the next coarser one falls to this share of the
/// tolerance, so that a level at its border does not flicker.
constexpr double HYSTERESIS = 0.7;

}  // namespace vegetation_sim
