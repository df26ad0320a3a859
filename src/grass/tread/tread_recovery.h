// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

/// Returns the share of its tilt that a node keeps: 1 - smoothStep((t - t0) / T), or 0 before t0.
inline double tiltLeft(const TreadNode& node, Nanoseconds stamp) {
  if (stamp < node.stamp || !(node.recovery > 0.f)) return 0.0;
  if (node.recovery >= static_cast<float>(PERMANENT_RECOVERY)) return 1.0;
  return 1.0 - smoothStep(secondsBetween(node.stamp, stamp) / double{node.recovery});
}

/// Returns the tilt of a node at a stamp [rad].
inline float tiltAt(const TreadNode& node, Nanoseconds stamp) {
  return static_cast<float>(double{node.tilt} * tiltLeft(node, stamp));
}

}  // namespace vegetation_sim::grass
