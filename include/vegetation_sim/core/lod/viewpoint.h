// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// An eye: where it is and how many pixels a metre at one metre takes.
struct Viewpoint {
  Vec3 position{Vec3::Zero()};
  double pixels_per_radian{1000.0};
  Vec3 forward{Vec3::UnitX()};  ///< unit
  double cone_cosine{-1.0};     ///< of half the angle of the cone that it sees; -1: all round
};
/// True if the eye sees any of a ball.
bool sees(const Viewpoint& eye, const Vec3& centre, double radius);
/// Pixels that one metre takes at `distance` [m], which counts as half a metre if it is less.
double pixelsPerMetre(const Viewpoint& eye, double distance);

/// A finer level is kept until the next coarser one holds this share of the tolerance, so that a
/// level at its border does not flicker.
constexpr double HYSTERESIS = 0.7;

}  // namespace vegetation_sim
