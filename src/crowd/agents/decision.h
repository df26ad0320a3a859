// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "crowd/agents/perception.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {

/// Direction and speed of a walker: (v, phi) of paper 2, section 5.2, phi as a direction.
struct Command {
  Point direction{1.0, 0.0};  ///< unit
  double speed{0.0};          ///< [m/s]
};

/// Motion that a walker wants before it perceives obstacles.
struct Wish {
  Point direction{1.0, 0.0};  ///< unit, to the goal or along the way around walls
  double speed{0.0};          ///< [m/s]; 0: the walker stands
};

/// Returns a vector turned to the left by an angle.
inline Point turned(const Point& v, const SinCos& by) {
  return {by.cos * v.x - by.sin * v.y, by.sin * v.x + by.cos * v.y};
}

/// Returns the standard deviation of a noise at a distance: from 0 at contact to `most` at the
/// sensor's range; or as printed its inverse, limited to ten times `most` (S2-33, E7). @param most
/// `noise_heading` or `noise_speed`.
double noiseAt(const CrowdSettings& settings, double most, double distance);

/// Returns a speed with noise, which never reverses or more than doubles it. @param noise relative.
inline double noisySpeed(double speed, double noise) {
  return speed * (1.0 + std::min(1.0, std::max(-1.0, noise)));
}

/// Returns a nearly normal random number with mean 0 and variance 1: the sum of eight uniform ones.
double normalNumber(std::uint64_t key, std::uint64_t index);

/// Evaluates a fan of directions by how far the walker can go until it meets something in its view,
/// and takes the one that ends nearest to the wanted place (similar to Moussaid, Helbing and
/// Theraulaz 2011). A side once taken is kept. Robots are evaded even while standing. @param side
/// output: 1 left, -1 right, 0 none.
Command decideByGoal(const Walker& walker, const View& view, const CrowdSettings& settings,
                     const Wish& wish, Nanoseconds stamp, int& side);

}  // namespace vegetation_sim::crowd
