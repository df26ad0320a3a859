// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/agents/perception.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {

/// Where to walk, and how fast: (v, phi) of paper 2, section 5.2, phi as a direction.
struct Command {
  Point direction{1.0, 0.0};  ///< unit
  double speed{0.0};          ///< [m/s]
};

/// What a walker wants before it looks around.
struct Wish {
  Point direction{1.0, 0.0};  ///< unit: to the goal, or along the way around walls
  double speed{0.0};          ///< [m/s]; 0: it stands
};

/// Returns a vector turned to the left by an angle.
inline Point turned(const Point& v, const SinCos& by) {
  return {by.cos * v.x - by.sin * v.y, by.sin * v.x + by.cos * v.y};
}

/// Standard deviation of the heading's noise at a distance [rad]: growing from 0 at contact to its
/// largest at the sensor's range, or as printed the other way round, there bounded by ten times
/// (S2-33, E7).
double noiseAt(const CrowdSettings& settings, double distance);

/// A number with mean 0 and variance 1, near to normal: the sum of eight uniform ones.
double normalNumber(std::uint64_t key, std::uint64_t index);

/// Looks along a fan of directions for how far each is free of all that the view holds, as it
/// moves, and takes the one that ends nearest to where the wish leads (in the manner of Moussaid,
/// Helbing and Theraulaz 2011). A side once taken is kept; robots are evaded even while standing.
/// @param side that is taken: 1 left, -1 right, 0 none.
Command decideByGoal(const Walker& walker, const View& view, const CrowdSettings& settings,
                     const Wish& wish, Nanoseconds stamp, int& side);

}  // namespace vegetation_sim::crowd
