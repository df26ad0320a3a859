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

/// The level above all depths: every joint moves, by the modes of the tree (N13).
constexpr int MODAL_LEVEL = MAX_DEPTHS + 1;
/// Weight of the joints of each recursion depth, from 0 (fixed at rest) to 1 (moves); the last is
/// the weight of the modes against the procedural motion.
using Weights = std::array<double, MODAL_LEVEL>;

/// States of a tick are extrapolated by at most this time [s].
constexpr double LONGEST_LOOK_AHEAD = 0.05;

/// Level of one tree as a function of time (S1-21..S1-24). Joints of depth below `level` move.
/// blend[d] is the blend of depth d at `since`; from there it rises to 1 where d < level and falls
/// to 0 elsewhere at constant speed, so a new change starts from the current blend.
struct LevelState {
  int level{0};
  Nanoseconds since{0};
  std::array<float, MODAL_LEVEL> blend{};  // float: as sent, so that replicas hold the same bits

  bool operator==(const LevelState& other) const {
    return level == other.level && since == other.since && blend == other.blend;
  }
  /// Returns a state without a transition.
  static LevelState settled(int level);
};

/// Returns the blend of each depth at `stamp` before shaping: alpha of paper 1.
Weights blendAt(const LevelState& state, Nanoseconds stamp, double transition);
/// Returns the weights at `stamp`: alpha, or smoothStep(alpha), whose rate is 0 at both ends.
Weights weightsAt(const LevelState& state, Nanoseconds stamp, const MotionLaw& law);
/// Starts a change to `level` at `stamp`. The blend is continuous.
void setLevel(LevelState& state, int level, Nanoseconds stamp, double transition);
bool isSettled(const LevelState& state, Nanoseconds stamp, double transition);
/// Returns the number of depths with any weight.
int movingDepths(const Weights& weights);
/// Returns the weight of the modes against the procedural motion.
inline double modalWeight(const Weights& weights) {
  return weights[MAX_DEPTHS];
}

}  // namespace vegetation_sim::forest
