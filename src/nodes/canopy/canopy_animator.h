// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <vegetation_sim/CanopyEvent.h>
#include <vegetation_sim/CutPlants.h>
#include <vegetation_sim/SampleCanopy.h>
#include <vegetation_sim/WindField.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "canopy/plants/plant_index.h"
#include "nodes/base/event_node.h"
#include "nodes/bodies/robot_bodies.h"
#include "nodes/canopy/canopy_cover.h"
#include "nodes/canopy/canopy_options.h"
#include "nodes/canopy/delayed_people.h"
#include "nodes/cutters/cutter_follower.h"
#include "nodes/markers/canopy_markers.h"
#include "ros/replicas/hashed_cache.h"
#include "ros/replicas/leafed_crowns.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// Leaves on ROS: runs canopy::Canopy on the tick grid of ROS time, publishes layout, state and
/// markers, answers services.
class CanopyAnimator final
    : public EventNode<EventQueue<CanopyEvent>, CanopyAnimatorConfig, CanopyOptions> {
 public:
  /// @throws InvalidInput for invalid parameters or an invalid scenario.
  CanopyAnimator(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~CanopyAnimator() override { stop(); }

 private:
  // Inputs.
  void connect() override;
  void onWind(const WindField& message);
  void onViewer(const Viewer& message) override;
  void showTuning(CanopyAnimatorConfig& config) const override;
  CanopyEvent tuningEvent(const CanopyAnimatorConfig& config) const override;
  bool isOutdated(const CanopyEvent& event, Nanoseconds now) const override;
  void forgetViewer();
  void publishBeginning(Nanoseconds stamp);
  void updateCrowns();
  void followBodies(std::int64_t tick);
  void followCutters(Nanoseconds stamp);
  CanopyEvent cutEvent(const grass::CutArea& area) const;
  std::uint32_t countHigher(const CanopyEvent& cut) const;

  // Time.
  void tick(std::int64_t tick) override;
  void apply(CanopyEvent& event) override;
  void applyCut(CanopyEvent& event);
  /// A wind received lately, or calm. @throws InvalidInput for any other hash.
  wind::Field windOf(std::uint64_t hash) const;
  void restart(Nanoseconds now) override;
  void onRecovered(const CanopyEvent& event) override;

  // Snapshots.
  std::uint64_t sceneHash() const override;
  std::uint64_t stateHash() const override { return canopy_.snapshot().hash(); }
  void writeState(Archive& a) const override;
  CheckedState readState(Archive& a) override;
  void queueNewerWind();
  std::string inputOf(const CanopyEvent& event) const override;
  std::function<void()> readInput(CanopyEvent& event, const std::string& bytes,
                                  Nanoseconds shift) override;

  // Outputs.
  void publishLayout();
  void publishState(std::int64_t tick);
  void publishContacts();
  void publishCover(std::int64_t tick);
  std::vector<Viewpoint> markerViewers(Nanoseconds stamp) override;
  void addDiagnostics(Status& status) override;
  void addGovernor(Status& status) override { markers_.reportTiers(status); }
  std::vector<PredictedError> predictErrors() const override;

  // Services.
  bool onSample(SampleCanopy::Request& request, SampleCanopy::Response& response);
  bool onCut(CutPlants::Request& request, CutPlants::Response& response);
  bool onCutting(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  CanopySample sampleAt(const Vec3& place);

  canopy::Canopy canopy_;
  canopy::PlantIndex plants_;
  CanopyCover cover_;
  std::uint32_t cover_subscribers_{0};  // at the last tick
  SubscribedForest forest_;             // whose crowns have leaves of the layout
  LeafedCrowns crowns_;
  CanopyMarkers markers_;
  RobotBodies bodies_;
  DelayedPeople people_;  // who push plants
  CutterFollower cutters_;
  bool cuts_changed_{true};  // since the last state was sent
  std::size_t bodies_left_out_{0};
  bool had_bodies_{false};  // at the last tick
  HashedCache<wind::Field> winds_;
  std::uint64_t heard_wind_{0};  // hash of the newest one; 0: none
  struct Seen {
    std::string id;
    Nanoseconds stamp{0};
  };
  static void archive(Archive& a, std::optional<Seen>& viewer);
  std::optional<Seen> viewer_;  // for which layers are cut
  bool begun_{false};           // the beginning has been published

  std::uint64_t state_bytes_{0}, other_viewers_{0};
  std::uint64_t reported_resets_{0};   // of the fluid, when diagnostics were last sent
  std::uint64_t reported_refused_{0};  // plants that did not lean, likewise

  ros::Publisher layout_publisher_, state_publisher_, contacts_publisher_, cover_publisher_;
};

}  // namespace vegetation_sim
