// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/forest/layout.h"

namespace vegetation_sim::forest {

/// What modes tell of a species: how far the procedural rung, which answers the wind at once, is
/// off where wind comes and goes, and how far a tree turns. Measured on sample trees in a breeze;
/// 0 where joints do not bend.
struct Lag {
  /// Largest distance of any tip of the full chain from its procedural place in some seconds, per
  /// speed that comes and goes there (wind::Instant::gustBound) [m per m/s].
  double distance{0.0};
  /// Turns that gather along a way from the ground, per bending speed [rad per m/s].
  double turn{0.0};
};
Lag measureLag(const Species& species, const MotionLaw& law, double scale);

}  // namespace vegetation_sim::forest
