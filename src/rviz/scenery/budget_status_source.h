// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <optional>
#include <string>

#include "ros/replicas/input_status.h"

namespace vegetation_sim::view {

/// Node whose budget a display reports, and the keys of its diagnostics.
struct GovernorKeys {
  std::string node;          ///< name without namespace
  std::string cost, budget;  ///< keys, with the unit in brackets
};

/// Reads from /diagnostics how a node keeps its budget. Callbacks run in the queue of the node
/// handle, which is the render thread's for a display.
class GovernorSource {
 public:
  GovernorSource(ros::NodeHandle nh, GovernorKeys keys);

  /// Returns nothing before the first message, and a warning after 5 s without one.
  /// @param wall increasing wall time [s], since diagnostics do not follow ROS time.
  std::optional<InputStatus> status(double wall);

 private:
  void take(const diagnostic_msgs::DiagnosticArray& message);

  GovernorKeys keys_;
  std::string text_;
  bool fresh_{false};     // a message has arrived since the last status()
  double received_{0.0};  // wall time [s]
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim::view
