// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <string>

#include "nodes/base/node_base.h"
#include "nodes/sensors/sensor_options.h"
#include "ros/landscape/landscape_replica.h"
#include "ros/services/frame_listener.h"
#include "ros/services/missing_inputs.h"
#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// The common part of nodes that cast rays into the landscape from a tf frame. At each tick it
/// brings its replicas of the landscape to the stamp and lets the sensor measure. One thread calls
/// everything.
class SensorBase : public NodeBase {
 protected:
  /// @param task of the sensor, in its diagnostics. @param measurements what it takes, in
  /// warnings, such as "sweeps".
  SensorBase(const std::string& name, const ros::NodeHandle& handle,
             const ros::NodeHandle& private_handle, const SensorOptions& options, const char* task,
             std::string measurements);

  /// Begins to receive and to tick; to be called at the end of the constructor.
  void start();
  /// Ends both; to be called first in the destructor.
  void stop();

  /// Measures at the stamp of a tick.
  virtual void measure(std::int64_t tick) = 0;
  /// Adds the values of the sensor to the diagnostics.
  virtual void reportValues(Status& status) = 0;
  /// Forgets all trees.
  virtual void restartScene();

  /// Returns the pose of a frame in the world. If there is none, it is reported as missing.
  /// @param wanted whether this costs a measurement.
  bool findPose(const std::string& frame, Nanoseconds stamp, bool wanted, Pose& pose);
  /// Announces the sensor whether or not anybody listens to it, so that listening changes nothing.
  /// @param id follows the name of the node. @param range of the sensor [m].
  void announce(const std::string& id, const Vec3& place, double range);

  const SensorOptions common_;
  LandscapeReplica landscape_;
  scan::Scene scene_;
  ThreadPool threads_;
  MissingInputs missing_;
  tf2_ros::Buffer tf_buffer_;
  std::uint64_t unplaced_{0};  ///< measurements without a pose
  TickClock clock_;

 private:
  void tick(std::int64_t tick);
  void restart(Nanoseconds now);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void reportProblems(Status& status);
  void diagnose(Status& status);

  std::string measurements_;
  struct Counts {
    std::uint64_t unplaced{0}, lost{0}, incomplete{0};
    TickClock::Counts clock;
  } reported_;  ///< when diagnostics were last sent
  FrameListener tf_listener_;
  ros::Publisher interest_publisher_;
};

}  // namespace vegetation_sim
