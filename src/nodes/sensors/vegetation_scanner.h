// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <string>
#include <vector>

#include "nodes/sensors/scanner_options.h"
#include "ros/replicas/landscape_replica.h"
#include "ros/services/diagnostics.h"
#include "ros/services/missing_inputs.h"
#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// Simulates a lidar at a tf frame. At each tick it brings its replicas of the landscape to the
/// stamp, casts the rays and publishes their returns. One thread calls everything.
class VegetationScanner {
 public:
  /// @throws InvalidInput for invalid parameters.
  VegetationScanner(ros::NodeHandle handle, ros::NodeHandle private_handle);

 private:
  void listen();
  void tick(std::int64_t tick);
  void sweep(const Pose& sensor, std::int64_t tick);
  void restartScene();
  void restart(Nanoseconds now);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  /// Header of the current sweep.
  std_msgs::Header header() const;

  ros::NodeHandle handle_, private_handle_;
  ScanOptions options_;
  Refusals refusals_{"vegetation_scanner"};  // used by callbacks of landscape_
  LandscapeReplica landscape_;
  scan::Scene scene_;
  struct Counts {
    std::uint64_t sweeps{0}, unplaced{0}, lost{0};
    TickClock::Counts clock;
  } counts_, reported_;  // so far, and when diagnostics were last sent
  MissingInputs missing_;
  double cost_{0.0};         // wall time of the last sweep [s]
  std::uint32_t points_{0};  // of the last sweep

  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros::Publisher cloud_publisher_, scan_publisher_, report_publisher_;
  ros::ServiceServer reset_service_;
  TickClock clock_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace vegetation_sim
