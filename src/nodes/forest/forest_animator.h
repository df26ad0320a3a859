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
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/ForestAnimatorConfig.h>
#include <vegetation_sim/GetTree.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Pick.h>
#include <vegetation_sim/Release.h>
#include <vegetation_sim/SetTf.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forest/pick.h"
#include "nodes/forest/branch_frames.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/forest/forest_options.h"
#include "nodes/forest/grab_manager.h"
#include "nodes/markers/forest_markers.h"
#include "ros/services/diagnostics.h"
#include "ros/time/tick_clock.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

/// The forest on ROS: runs forest::Forest on the tick grid of ROS time, publishes its layout, state
/// and views, answers services. One thread calls everything. Program and nodelet are thin shells.
class ForestAnimator {
 public:
  /// @throws InvalidInput for parameters or a scenario that are refused.
  ForestAnimator(ros::NodeHandle handle, ros::NodeHandle private_handle);

 private:
  // Inputs.
  void onWind(const WindField& message);
  void onViewer(const Viewer& message);
  void onEvent(const ForestEvent& message) { inputs_.addEvent(message); }
  void onTuning(ForestAnimatorConfig& config);
  void lookFromFrame();
  /// @throws InvalidInput if tf does not lead from the frame to the world.
  geometry_msgs::Transform toWorld(const std::string& frame, const ros::Time& stamp) const;

  // Time.
  void listen();
  void restart(Nanoseconds now);
  void startAnew();
  void tick(std::int64_t tick);
  void apply(const ForestEvent& event);
  void applyInteraction(const ForestEvent& event);
  void settleGrabs();
  void followBodies(Nanoseconds stamp);
  void adoptTuning(const ForestTuning& tuning);

  // Outputs.
  void publishLayout();
  void sendFrames(const ros::TimerEvent& event);
  void sendBranches(const ros::TimerEvent& event);
  void sendMarkers(const ros::TimerEvent& event);
  void reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status);
  void addPhysics(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void noteOverlaps();

  // Services.
  bool onGetTree(GetTree::Request& request, GetTree::Response& response);
  bool onPick(Pick::Request& request, Pick::Response& response);
  bool onSetTf(SetTf::Request& request, SetTf::Response& response);
  bool onGrab(Grab::Request& request, Grab::Response& response);
  bool onMoveGrab(MoveGrab::Request& request, MoveGrab::Response& response);
  bool onRelease(Release::Request& request, Release::Response& response);
  bool onApplyForce(ApplyForce::Request& request, ApplyForce::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  forest::Ray rayOf(const Pick::Request& request) const;
  Nanoseconds stampOf(const ros::Time& stamp) const;

  ros::NodeHandle handle_, private_handle_;
  ForestScene scene_;  // as loaded, before the designer's factors
  ForestOptions options_;
  ForestTuning tuning_;
  ForestInputs inputs_;
  std::unique_ptr<forest::Forest> forest_;
  forest::TreeCache cache_;
  BranchFrames frames_;
  ForestMarkers markers_;

  std::optional<std::int64_t> last_framed_;  // tick
  std::size_t frames_sent_{0};               // at the last round
  bool force_key_frame_{true};
  std::optional<ForestAnimatorConfig> shown_;  // what the server was told or took last
  struct Counts {
    std::uint64_t state_bytes{0}, leases_ended{0};
    QueueLosses inputs;
    TickClock::Counts clock;
  } counts_, reported_;    // so far, and when diagnostics were last sent
  QueueLosses published_;  // on the console
  Refusals refusals_{"forest_animator"};
  forest::Reaction deepest_;  // of the contacts since diagnostics were last sent

  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
  std::unique_ptr<GrabManager> grabs_manager_;
  std::unique_ptr<RobotBodies> bodies_;
  ros::Publisher layout_publisher_, state_publisher_, branches_publisher_, markers_publisher_,
      events_publisher_, wrenches_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Timer> timers_;
  std::unique_ptr<dynamic_reconfigure::Server<ForestAnimatorConfig>> tuning_server_;
  TickClock clock_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace vegetation_sim
