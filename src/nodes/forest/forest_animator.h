// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <tf2_ros/transform_broadcaster.h>
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/CutBranch.h>
#include <vegetation_sim/FindBranch.h>
#include <vegetation_sim/FindTrees.h>
#include <vegetation_sim/ForestAnimatorConfig.h>
#include <vegetation_sim/GetTree.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Pick.h>
#include <vegetation_sim/Release.h>
#include <vegetation_sim/SensorInterest.h>
#include <vegetation_sim/SetTf.h>
#include <vegetation_sim/WindField.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "forest/pick.h"
#include "nodes/base/event_node.h"
#include "nodes/cutters/cutter_follower.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/forest/forest_options.h"
#include "nodes/forest/frames/branch_frames.h"
#include "nodes/forest/grab_manager.h"
#include "nodes/listeners/viewer_registry.h"
#include "nodes/markers/forest_markers.h"
#include "ros/replicas/hashed_cache.h"
#include "ros/time/warning_interval.h"

namespace vegetation_sim {

/// The forest on ROS: runs forest::Forest on the tick grid of ROS time, publishes its layout, state
/// and views, answers services.
class ForestAnimator final : public EventNode<ForestInputs, ForestAnimatorConfig, ForestOptions> {
 public:
  /// @throws InvalidInput for invalid parameters or an invalid scenario.
  ForestAnimator(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~ForestAnimator() override { stop(); }

 private:
  // Inputs.
  void connect() override;
  void onWind(const WindField& message);
  void onSensor(const SensorInterest& message);
  void showTuning(ForestAnimatorConfig& config) const override;
  ForestInput tuningEvent(const ForestAnimatorConfig& config) const override;
  bool isOutdated(const ForestInput& event, Nanoseconds now) const override;

  // Time.
  void restart(Nanoseconds now) override;
  void onRecovered(const ForestInput& event) override;
  void resetForest();
  void tick(std::int64_t tick) override;
  void apply(ForestInput& event) override;
  void applyInteraction(const ForestInput& event);
  void updateGrabs(std::int64_t tick);
  void publishForces();
  void publishBreaks();
  void followBodies(Nanoseconds stamp);
  void followCutters(Nanoseconds stamp);
  void reportLostGrabs();
  void applyTuning(const ForestTuning& tuning);
  /// The scenario's layout with the design of a tuning.
  forest::Layout designedLayout(const ForestTuning& tuning) const;

  // Snapshots.
  std::uint64_t sceneHash() const override;
  std::uint64_t stateHash() const override { return forest_->hash(); }
  void writeState(Archive& a) const override;
  CheckedState readState(Archive& a) override;
  void queueNewerWind();
  std::string inputOf(const ForestInput& event) const override;
  std::function<void()> readInput(ForestInput& event, const std::string& bytes,
                                  Nanoseconds shift) override;

  // Outputs.
  void publishLayout();
  void publishTrunks();
  void publishState(bool key_frame);
  void sendFrames();
  void sendBranches();
  void addDiagnostics(Status& status) override;
  void addGovernor(Status& status) override;
  std::vector<PredictedError> predictErrors() const override;
  void addDetail(Status& status, const std::string& whose, const forest::DetailChooser& choice,
                 const forest::TreeDetail& detail) const;
  void addPhysics(Status& status);
  void updateDeepestOverlap();

  // Services, and which shards answer requests; routes run in threads of ShardRequests.
  void connectServices();
  std::vector<std::uint32_t> ownersOf(std::uint32_t tree);
  std::vector<std::uint32_t> ownersOfGrab(std::uint32_t id) const;
  std::vector<std::uint32_t> ownersNear(const geometry_msgs::PointStamped& point);
  std::vector<std::uint32_t> ownersAlong(const Pick::Request& request);
  std::vector<std::uint32_t> ownersOfNearest(const geometry_msgs::PointStamped& point);
  template <class ServiceRequest>
  std::vector<std::uint32_t> ownersOfPlace(const ServiceRequest& request);
  bool onGetTree(GetTree::Request& request, GetTree::Response& response);
  bool onFindTrees(FindTrees::Request& request, FindTrees::Response& response);
  FoundTree foundTree(std::uint32_t id);
  bool onPick(Pick::Request& request, Pick::Response& response);
  std::optional<forest::Picked> pickAlong(
      const Pick::Request& request, const std::function<bool(std::uint32_t tree)>& is_searched);
  bool onFindBranch(FindBranch::Request& request, FindBranch::Response& response);
  bool onSetTf(SetTf::Request& request, SetTf::Response& response);
  bool onGrab(Grab::Request& request, Grab::Response& response);
  bool onMoveGrab(MoveGrab::Request& request, MoveGrab::Response& response);
  bool onRelease(Release::Request& request, Release::Response& response);
  bool onApplyForce(ApplyForce::Request& request, ApplyForce::Response& response);
  bool onCutBranch(CutBranch::Request& request, CutBranch::Response& response);
  bool onCutting(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  forest::Ray rayOf(const Pick::Request& request) const;
  Nanoseconds stampOf(const ros::Time& stamp) const;

  HashedCache<wind::Field> winds_;
  std::uint64_t heard_wind_{0};  // hash of the newest one; 0: none
  ForestTuning tuning_;
  std::unique_ptr<forest::Forest> forest_;
  forest::TreeCache cache_;
  GrabManager grab_manager_;
  RobotBodies bodies_;
  CutterFollower cutters_;
  BranchFrames frames_;
  ForestMarkers markers_;
  forest::BrokenTrees trunks_broken_;  // in the published trunks

  std::size_t frames_sent_{0};  // at the last round
  bool force_key_frame_{true}, grabs_published_{false};
  std::uint64_t state_bytes_{0}, leases_ended_{0};
  std::uint64_t grabs_lost_{0}, reported_grabs_lost_{0};  // to another design
  WarningInterval uncut_warning_, budget_warning_{10.0};
  std::uint64_t left_uncut_{0}, reported_left_uncut_{0};  // branches that tools have met
  forest::Reaction deepest_;  // of the contacts since diagnostics were last sent

  tf2_ros::TransformBroadcaster tf_broadcaster_;
  ros::Publisher layout_publisher_, trunks_publisher_, state_publisher_, view_publisher_,
      branches_publisher_, wrenches_publisher_, forces_publisher_, grabs_publisher_,
      breaks_publisher_;
};

}  // namespace vegetation_sim
