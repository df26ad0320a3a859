// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/lod/viewpoint.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim {
namespace {

constexpr double NEAREST = 0.5;  // [m] objects closer than this do not appear larger

}  // namespace

bool sees(const Viewpoint& viewpoint, const Vec3& centre, double radius) {
  if (viewpoint.cone_cosine <= -1.0) return true;
  const Vec3 offset = centre - viewpoint.position;
  const double distance = length(offset);
  if (distance <= radius) return true;
  // These are cosine and sine of the sum of the cone's half angle and the angular radius of the
  // ball.
  const double c = viewpoint.cone_cosine, s = std::sqrt(std::max(0.0, 1.0 - c * c));
  const double ball_sine = radius / distance, ball_cosine = std::sqrt(1.0 - ball_sine * ball_sine);
  if (s * ball_cosine + c * ball_sine < 0.0) return true;  // the sum exceeds a half turn
  return dot(offset, viewpoint.forward) >= distance * (c * ball_cosine - s * ball_sine);
}

double pixelsPerMetre(const Viewpoint& viewpoint, double distance) {
  return viewpoint.pixels_per_radian / std::max(distance, NEAREST);
}

}  // namespace vegetation_sim
