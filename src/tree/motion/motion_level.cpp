// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/motion_level.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
LevelState LevelState::settled(int level) {
  LevelState out;
  out.level = level;
  for (int d = 0; d < MODAL_LEVEL; ++d)
    out.blend[static_cast<std::size_t>(d)] = d < level ? 1.f : 0.f;
  return out;
}

Weights blendAt(const LevelState& state, Nanoseconds stamp, double transition) {
  const double moved = std::max(0.0, secondsBetween(state.since, stamp) / transition);
  Weights out;
  for (int d = 0; d < MODAL_LEVEL; ++d) {
    const double from = state.blend[static_cast<std::size_t>(d)];
    out[static_cast<std::size_t>(d)] = saturate(d < state.level ? from + moved : from - moved);
  }
  return out;
}

Weights weightsAt(const LevelState& state, Nanoseconds stamp, const MotionLaw& law) {
  Weights out = blendAt(state, stamp, law.transition);
  if (law.transition_shape == TransitionShape::SMOOTH)
    for (double& weight : out) weight = smoothStep(weight);
  return out;
}

void setLevel(LevelState& state, int level, Nanoseconds stamp, double transition) {
  const auto now = blendAt(state, stamp, transition);
  for (std::size_t d = 0; d < MODAL_LEVEL; ++d) state.blend[d] = static_cast<float>(now[d]);
  state.level = level;
  state.since = stamp;
}

bool isSettled(const LevelState& state, Nanoseconds stamp, double transition) {
  const auto now = blendAt(state, stamp, transition);
  for (int d = 0; d < MODAL_LEVEL; ++d)
    if (now[static_cast<std::size_t>(d)] != (d < state.level ? 1.0 : 0.0)) return false;
  return true;
}

int movingDepths(const Weights& weights) {
  int out = MAX_DEPTHS;
  while (out > 0 && weights[static_cast<std::size_t>(out) - 1] <= 0.0) --out;
  return out;
}

}  // namespace vegetation_sim::forest
