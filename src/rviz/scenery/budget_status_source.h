// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <optional>
#include <string>

#include "rviz/scenery/input_status.h"

namespace vegetation_sim::view {

/// Whose governor, and which of its figures bind.
struct GovernorKeys {
  std::string node;          ///< in whatever namespace
  std::string cost, budget;  ///< keys of its diagnostics, the unit in brackets
};

/// Listens on /diagnostics to what a node's governor chose, and why. Callbacks run in the queue of
/// the node handle: for a display the render thread's.
class GovernorSource {
 public:
  GovernorSource(ros::NodeHandle nh, GovernorKeys keys);

  /// None before the first message; bad when 5 s have brought none.
  /// @param wall rising [s]: nodes send diagnostics by the wall's clock, whatever ROS time does.
  std::optional<InputStatus> status(double wall);

 private:
  void take(const diagnostic_msgs::DiagnosticArray& message);

  GovernorKeys keys_;
  std::string text_;
  bool fresh_{false};  // taken since the last status()
  double heard_{0.0};  // wall time [s]
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim::view
