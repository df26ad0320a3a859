// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
#include <vegetation_sim/CrowdEvent.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/RemoveAgents.h>
#include <vegetation_sim/SetAgentGoal.h>
#include <vegetation_sim/SpawnAgents.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nodes/base/event_queue.h"
#include "nodes/base/viewer_registry.h"
#include "nodes/crowd/crowd_options.h"
#include "nodes/crowd/crowd_robots.h"
#include "nodes/markers/crowd_markers.h"
#include "ros/replicas/hashed_cache.h"
#include "ros/services/diagnostics.h"
#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// People on ROS: steps crowd::Crowd on the tick grid of ROS time, publishes where they are and
/// what they tread, answers services. One thread calls everything. Program and nodelet are thin
/// shells.
class AgentCrowd {
 public:
  /// @throws InvalidInput for parameters or a scenario that are refused.
  AgentCrowd(ros::NodeHandle handle, ros::NodeHandle private_handle);

 private:
  // Inputs.
  void onLayout(const ForestLayout& message);
  void onCover(const nav_msgs::OccupancyGrid& message);
  void onViewer(const Viewer& message);
  void onEvent(const CrowdEvent& message) { inputs_.addRecorded(message); }
  void onTuning(AgentCrowdConfig& config);
  void followRobots(Nanoseconds stamp);
  crowd::Point placeInWorld(const geometry_msgs::Point& point, const Pose& to_world) const;
  void queue(CrowdEvent event);

  // Time.
  void listen();
  void populate();
  void keepPromises();
  /// Walkers that wait for their stamps.
  std::size_t awaited() const;
  void tick(std::int64_t tick);
  void publishBeginning(Nanoseconds stamp);
  void apply(const CrowdEvent& event);
  void applyToWalker(const CrowdEvent& event);
  void adoptTrunks(std::uint64_t hash);
  void adoptCover(std::uint64_t hash);
  void startAnew();
  void restart(Nanoseconds now);

  // Outputs.
  void publishAgents(Nanoseconds stamp);
  void publishTreads(Nanoseconds stamp);
  void treadOfBody(const crowd::Walker& walker, Nanoseconds stamp);
  void treadOfFeet(const crowd::Walker& walker, Nanoseconds stamp);
  std::vector<TierChoice> chooseFrames(Nanoseconds stamp);
  void sendFrames(const ros::TimerEvent& event);
  void sendMarkers(const ros::TimerEvent& event);
  void reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status);

  // Services.
  bool onSpawn(SpawnAgents::Request& request, SpawnAgents::Response& response);
  bool onRemove(RemoveAgents::Request& request, RemoveAgents::Response& response);
  bool onSetGoal(SetAgentGoal::Request& request, SetAgentGoal::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void refuseInReplay() const;
  void checkKnown(const std::vector<std::uint32_t>& ids) const;

  ros::NodeHandle handle_, private_handle_;
  CrowdScene scene_;
  CrowdOptions options_;
  EventQueue<CrowdEvent> inputs_;
  std::unique_ptr<crowd::Crowd> crowd_;
  CrowdMarkers markers_;
  ViewerRegistry viewers_;
  std::uint32_t promised_{0};  // next id that spawn tells
  HashedCache<ForestLayout> layouts_;
  HashedCache<nav_msgs::OccupancyGrid> covers_;
  bool begun_{false};  // a tick was done since the start or the last jump back
  std::size_t trunks_{0};
  Nanoseconds framed_{0};       // stamp of the last frames
  TierHysteresis held_frames_;  // 1: has one
  std::size_t frames_sent_{0};  // at the last round
  struct Trodden {
    crowd::Point place{};
    bool stood[2]{true, true};
    bool seen{false};
  };
  std::map<std::uint32_t, Trodden> trodden_;  // by walker
  std::optional<AgentCrowdConfig> shown_;     // what the server was told or took last
  struct Counts {
    std::uint64_t events{0}, treads{0}, state_bytes{0};
    QueueLosses inputs;
    TickClock::Counts clock;
  } counts_, reported_;    // so far, and when diagnostics were last sent
  QueueLosses published_;  // on the console
  Refusals refusals_{"agent_crowd"};

  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
  std::unique_ptr<CrowdRobots> robots_;
  ros::Publisher agents_publisher_, tread_publisher_, markers_publisher_, events_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Timer> timers_;
  std::unique_ptr<dynamic_reconfigure::Server<AgentCrowdConfig>> tuning_server_;
  TickClock clock_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace vegetation_sim
