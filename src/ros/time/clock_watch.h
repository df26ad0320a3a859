// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <functional>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// ROS time for a node: waits while it is zero, and tells when it goes backwards, by however
/// little. In simulation it goes by the messages of /clock in the order in which they come, in the
/// node's own queue, so that nothing is computed for a time that the node has not yet seen begin.
class ClockWatch {
 public:
  /// @param begin called with the time that begins: the first one, and any after a jump back. In
  /// the time of day already here.
  ClockWatch(ros::NodeHandle nh, std::function<void(Nanoseconds now)> begin);

  /// False until the first stamp that is not zero.
  bool running() const { return last_ > 0; }
  /// In simulation the last stamp seen, else the time of day.
  Nanoseconds now() const;
  int jumps() const { return jumps_; }

 private:
  void see(Nanoseconds now);

  std::function<void(Nanoseconds)> begin_;
  Nanoseconds last_{0};
  int jumps_{0};
  ros::Subscriber clock_;
  ros::WallTimer poll_;
};

}  // namespace vegetation_sim
