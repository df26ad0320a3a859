// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

using vegetation_sim::HYSTERESIS;
using vegetation_sim::pixelsPerMetre;
using vegetation_sim::sees;
using vegetation_sim::Viewpoint;

/// The level above all depths: every joint moves, and as the tree's modes do (N13).
constexpr int MODAL_LEVEL = MAX_DEPTHS + 1;
/// Weight of the joints of each recursion depth, 0 (fixed at rest) to 1 (moves); the last is that
/// of the modes over the procedural motion.
using Weights = std::array<double, MODAL_LEVEL>;

/// States of a tick are extrapolated by at most this time [s].
constexpr double LONGEST_LOOK_AHEAD = 0.05;

/// Level of one tree as a function of time (S1-21..S1-24). Joints of depth below `level` move.
/// blend[d] is where depth d was at `since`; from there it rises to 1 where d < level and falls to
/// 0 elsewhere, at constant speed, so a change of mind turns round wherever it stands.
struct LevelState {
  int level{0};
  Nanoseconds since{0};
  std::array<float, MODAL_LEVEL> blend{};  // float: as sent, so that replicas hold the same bits

  bool operator==(const LevelState& other) const {
    return level == other.level && since == other.since && blend == other.blend;
  }
  /// Settled at a level for ever.
  static LevelState settled(int level);
};

/// How far each depth is at `stamp`, before shaping: alpha of paper 1.
Weights blendAt(const LevelState& state, Nanoseconds stamp, double transition);
/// Weights at `stamp`: alpha itself, or smoothStep(alpha), which starts and ends at rest.
Weights weightsAt(const LevelState& state, Nanoseconds stamp, const MotionLaw& law);
/// Starts a change to `level` at `stamp`; continuous at any time.
void setLevel(LevelState& state, int level, Nanoseconds stamp, double transition);
bool isSettled(const LevelState& state, Nanoseconds stamp, double transition);
/// Number of depths that carry any weight.
int movingDepths(const Weights& weights);
/// Weight of the modes over the procedural motion.
inline double modalWeight(const Weights& weights) {
  return weights[MAX_DEPTHS];
}

}  // namespace vegetation_sim::forest
