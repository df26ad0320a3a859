// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <functional>

#include "ros/time/backward_step.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// ROS time for a node. It waits while time is zero and reports every jump back (BackwardStep).
/// With simulated time it follows the messages of /clock in the node's own callback queue, so that
/// a callback never computes for a time that has not yet begun for the node.
class ClockWatch {
 public:
  /// @param begin called with the first time and with any after a jump back; with wall time, by the
  /// constructor.
  ClockWatch(ros::NodeHandle nh, std::function<void(Nanoseconds now)> begin);

  /// False until the first stamp that is not zero.
  bool running() const { return clock_times_.newest() > 0; }
  /// Returns the newest stamp of /clock with simulated time, else the wall time. It does not go
  /// back but by a jump.
  Nanoseconds now() const;
  int jumps() const { return jumps_; }

 private:
  void see(Nanoseconds now);

  std::function<void(Nanoseconds)> begin_;
  BackwardStep clock_times_;
  int jumps_{0};
  ros::Subscriber clock_;
  ros::WallTimer poll_;
};

}  // namespace vegetation_sim
