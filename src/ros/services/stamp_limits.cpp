// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/stamp_limits.h"

#include <cstdio>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

bool isTooFarAhead(Nanoseconds stamp, Nanoseconds now) {
  return secondsBetween(now, stamp) > FARTHEST_AHEAD;
}

void requireNear(Nanoseconds stamp, Nanoseconds now) {
  if (!isTooFarAhead(stamp, now)) return;
  char out[128];
  std::snprintf(out, sizeof out, "stamp = %.3f s is %.3f s ahead, allowed are %g s",
                secondsBetween(0, stamp), secondsBetween(now, stamp), FARTHEST_AHEAD);
  throw InvalidInput(out);
}

}  // namespace vegetation_sim
