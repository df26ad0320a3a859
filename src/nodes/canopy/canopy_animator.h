// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <vegetation_sim/CanopyEvent.h>
#include <vegetation_sim/SampleCanopy.h>
#include <vegetation_sim/Viewer.h>
#include <vegetation_sim/WindField.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canopy/plants/plant_index.h"
#include "nodes/base/event_queue.h"
#include "nodes/canopy/canopy_options.h"
#include "nodes/markers/canopy_markers.h"
#include "ros/replicas/leafed_crowns.h"
#include "ros/services/diagnostics.h"
#include "ros/time/tick_clock.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// Leaves on ROS: runs canopy::Canopy on the tick grid of ROS time, publishes layout, state and
/// markers, answers services. One thread calls everything. Program and nodelet are thin shells.
class CanopyAnimator {
 public:
  /// @throws InvalidInput for parameters or a scenario that are refused.
  CanopyAnimator(ros::NodeHandle handle, ros::NodeHandle private_handle);

 private:
  // Inputs.
  void onWind(const WindField& message);
  void onViewer(const Viewer& message);
  void onEvent(const CanopyEvent& message) { inputs_.addRecorded(message); }
  void onTuning(CanopyAnimatorConfig& config);
  void lookFromFrame();
  void forgetViewer();
  void publishBeginning(Nanoseconds stamp);
  void updateCrowns();

  // Time.
  void listen();
  void tick(std::int64_t tick);
  void apply(const CanopyEvent& event);
  /// One of those that were heard, or calm. @throws InvalidInput for any other.
  wind::Field windOf(std::uint64_t hash) const;
  void restart(Nanoseconds now);

  // Outputs.
  void publishLayout();
  void publishState(std::int64_t tick);
  void sendMarkers(const ros::TimerEvent& event);
  /// Of the forest's crowns, as many as markers_ draws.
  std::vector<canopy::MovedLeaf> crownLeaves(const canopy::Foliage& foliage) const;
  void reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status);

  // Services.
  bool onSample(SampleCanopy::Request& request, SampleCanopy::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  CanopySample sampleAt(const Vec3& place);

  ros::NodeHandle handle_, private_handle_;
  CanopyScene scene_;
  CanopyOptions options_;
  EventQueue<CanopyEvent> inputs_;
  std::unique_ptr<canopy::Canopy> canopy_;
  canopy::PlantIndex plants_;
  CanopyMarkers markers_;
  SubscribedForest forest_;  // whose crowns have leaves of the layout
  LeafedCrowns crowns_;
  std::deque<wind::Field> winds_;  // heard last, newest at the end: what events of wind may name
  struct Seen {
    std::string id;
    Nanoseconds stamp{0};
  };
  std::optional<Seen> viewer_;  // who looks
  bool begun_{false};           // the beginning has been published

  std::optional<CanopyAnimatorConfig> shown_;  // what the server was told or took last
  struct Counts {
    std::uint64_t state_bytes{0}, other_viewers{0}, resets{0};
    QueueLosses inputs;
    TickClock::Counts clock;
  } counts_, reported_;    // so far, and when diagnostics were last sent
  QueueLosses published_;  // on the console
  Refusals refusals_{"canopy_animator"};

  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros::Publisher layout_publisher_, state_publisher_, markers_publisher_, events_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer markers_timer_;
  std::unique_ptr<dynamic_reconfigure::Server<CanopyAnimatorConfig>> tuning_server_;
  TickClock clock_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace vegetation_sim
