// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/canopy.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

/// Makes two shrubs, one behind the other as seen from the west, in a plane that faces east.
inline Layout shrubScene(int cells = 32) {
  Layout out;
  out.seed = 5;
  out.motion.fluid.cells = cells;
  out.motion.cuts.near_end = out.motion.cuts.mid_end = 100.0;
  out.kinds.resize(1);
  out.kinds[0].leaves = 200;
  out.plants.resize(2);
  out.plants[0].seed = 1;
  out.plants[1].seed = 2;
  out.plants[1].position = Vec3(2.0, 0.3, 0.0);
  out.plants[1].yaw = 0.5;
  return out;
}

inline wind::Field breezeFrom(const Vec3& velocity) {
  wind::Primitive breeze;
  breeze.id = 1;
  breeze.name = "breeze";
  breeze.kind = wind::Kind::BREEZE;
  breeze.velocity = velocity;
  return wind::Field({breeze}, 3);
}

inline Nanoseconds tickStamp(int tick) {
  return 1600000000LL * NANOSECONDS_PER_SECOND + tick * NANOSECONDS_PER_SECOND / 30;
}

inline void run(Canopy& canopy, int from, int to) {
  for (int tick = from; tick < to; ++tick) canopy.advance(tickStamp(tick));
}

}  // namespace vegetation_sim::canopy
