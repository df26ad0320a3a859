// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <vegetation_sim/ClearGrass.h>
#include <vegetation_sim/GrassEvent.h>
#include <vegetation_sim/SampleGrass.h>
#include <vegetation_sim/Tread.h>
#include <vegetation_sim/Viewer.h>
#include <vegetation_sim/WindField.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nodes/base/event_queue.h"
#include "nodes/base/key_frames.h"
#include "nodes/base/viewer_registry.h"
#include "nodes/grass/grass_cover.h"
#include "nodes/grass/grass_options.h"
#include "nodes/grass/grass_sources.h"
#include "nodes/markers/grass_markers.h"
#include "ros/services/diagnostics.h"
#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// A meadow on ROS: takes treads on the tick grid of ROS time, publishes layout, trodden ground and
/// views of it, answers services. One thread calls everything. Program and nodelet are thin shells.
class GrassField {
 public:
  /// @throws InvalidInput for parameters or a scenario that are refused.
  GrassField(ros::NodeHandle handle, ros::NodeHandle private_handle);

 private:
  // Inputs.
  void onWind(const WindField& message);
  void onViewer(const Viewer& message);
  void onTread(const TreadEvent& message);
  void onEvent(const GrassEvent& message);
  void onTuning(GrassFieldConfig& config);
  void lookFromFrame();
  void followSources(Nanoseconds stamp);
  TreadEvent inWorld(const TreadEvent& message) const;

  // Time.
  void listen();
  void tick(std::int64_t tick);
  void apply(const GrassEvent& event);
  void adoptTuning(GrassTuning tuning);
  void startAnew();
  void restart(Nanoseconds now);

  // Outputs.
  void publishLayout();
  void publishState(std::int64_t tick);
  void publishEntering(Nanoseconds stamp);
  void publishWrenches(Nanoseconds stamp);
  void sendMarkers(const ros::TimerEvent& event);
  void sendCover(const ros::TimerEvent& event);
  void reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status);

  // Services.
  bool onTreadPath(Tread::Request& request, Tread::Response& response);
  bool onSample(SampleGrass::Request& request, SampleGrass::Response& response);
  bool onClear(ClearGrass::Request& request, ClearGrass::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::vector<Vec3> pathOf(const Tread::Request& request) const;
  void queuePath(const std::vector<Vec3>& path, const grass::TreadLaw& law, const ros::Time& stamp);
  GrassSample sampleAt(const Vec3& place, Nanoseconds stamp) const;
  void refuseInReplay() const;

  ros::NodeHandle handle_, private_handle_;
  GrassScene scene_;
  GrassOptions options_;
  GrassTuning tuning_;
  EventQueue<GrassEvent> inputs_;
  std::unique_ptr<grass::MeadowLod> meadow_;  // of the markers
  std::unique_ptr<grass::TreadMap> tread_;
  std::unique_ptr<grass::TreadSimulation> field_;
  wind::Field wind_;
  GrassMarkers markers_;
  KeyFrames key_frames_;
  ViewerRegistry viewers_;

  std::uint64_t paths_{0};                 // trodden by service, for the names of their sources
  std::optional<GrassFieldConfig> shown_;  // what the server was told or took last
  struct Counts {
    std::uint64_t state_bytes{0}, largest_state{0}, events{0};
    QueueLosses inputs;
    TickClock::Counts clock;
    grass::TreadCounts tread;
  } counts_, reported_;    // so far, and when diagnostics were last sent
  QueueLosses published_;  // on the console
  Refusals refusals_{"grass_field"};

  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  std::unique_ptr<GrassSources> sources_;
  ros::Publisher layout_publisher_, state_publisher_, markers_publisher_, events_publisher_,
      wrenches_publisher_, cover_publisher_;
  std::array<ros::Publisher, COVER_LAYERS.size()> layer_publishers_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Timer> timers_;
  std::unique_ptr<dynamic_reconfigure::Server<GrassFieldConfig>> tuning_server_;
  TickClock clock_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace vegetation_sim
