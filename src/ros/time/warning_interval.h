// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

namespace vegetation_sim {

/// Limits how often a node repeats a warning. ROS_WARN_THROTTLE shares its time between all nodes
/// of a process, so that one nodelet would silence the others. For one thread at a time.
class WarningInterval {
 public:
  /// @param seconds of wall time.
  explicit WarningInterval(double seconds = 1.0) : length_(seconds) {}

  /// Returns whether the interval has passed since this last returned true.
  bool hasPassed() {
    const ros::WallTime now = ros::WallTime::now();
    if (now - last_ < length_) return false;
    last_ = now;
    return true;
  }

 private:
  ros::WallDuration length_;
  ros::WallTime last_;
};

}  // namespace vegetation_sim
