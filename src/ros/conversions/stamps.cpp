// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

Nanoseconds fromMsg(const ros::Time& stamp) {
  return static_cast<Nanoseconds>(stamp.sec) * NANOSECONDS_PER_SECOND + stamp.nsec;
}

ros::Time toStamp(Nanoseconds stamp) {
  if (stamp <= 0) return {};
  return {static_cast<std::uint32_t>(stamp / NANOSECONDS_PER_SECOND),
          static_cast<std::uint32_t>(stamp % NANOSECONDS_PER_SECOND)};
}

}  // namespace vegetation_sim
