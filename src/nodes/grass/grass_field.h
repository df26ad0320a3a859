// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <std_srvs/SetBool.h>
#include <vegetation_sim/ClearGrass.h>
#include <vegetation_sim/CutGrass.h>
#include <vegetation_sim/GrassEvent.h>
#include <vegetation_sim/GrassForces.h>
#include <vegetation_sim/GrassState.h>
#include <vegetation_sim/NearGrass.h>
#include <vegetation_sim/SampleGrass.h>
#include <vegetation_sim/SensorInterest.h>
#include <vegetation_sim/SetGrassColours.h>
#include <vegetation_sim/Tread.h>
#include <vegetation_sim/TreadEvents.h>
#include <vegetation_sim/WindField.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "nodes/base/event_node.h"
#include "nodes/base/key_frames.h"
#include "nodes/cutters/cutter_follower.h"
#include "nodes/grass/cover/cover_join.h"
#include "nodes/grass/cover/grass_cover.h"
#include "nodes/grass/grass_options.h"
#include "nodes/grass/grass_sources.h"
#include "nodes/grass/treads/near_treads.h"
#include "nodes/grass/treads/tread_senders.h"
#include "nodes/grass/whole_meadow.h"
#include "nodes/listeners/sensor_registry.h"
#include "nodes/markers/grass_markers.h"
#include "vegetation_sim/grass/lod/colour_mask.h"

namespace vegetation_sim {

/// A meadow on ROS: takes treads on the tick grid of ROS time, publishes layout, trodden ground and
/// views of it, answers services.
class GrassField final : public EventNode<EventQueue<GrassEvent>, GrassFieldConfig, GrassOptions> {
 public:
  /// @throws InvalidInput for invalid parameters or an invalid scenario.
  GrassField(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~GrassField() override { stop(); }

 private:
  // Inputs.
  void connect() override;
  void onWind(const WindField& message);
  void onTread(const TreadEvent& message);
  void onTreads(const TreadEvents& message);
  /// Whether ticks await what other nodes send.
  bool awaitsNodes() const { return options_.frame_wait > 0.0 && !options_.replay; }
  void awaitTreads(Nanoseconds stamp);
  void awaitInputsToSave() override;
  void onSensor(const SensorInterest& message);
  void showTuning(GrassFieldConfig& config) const override { toConfig(tuning_, config); }
  GrassEvent tuningEvent(const GrassFieldConfig& config) const override;
  /// ENTER is an output of the recorded node.
  bool isInput(const GrassEvent& event) const override { return event.kind != GrassEvent::ENTER; }
  bool isOutdated(const GrassEvent& event, Nanoseconds now) const override;
  void followSources(Nanoseconds stamp);
  void followCutters(Nanoseconds stamp);
  TreadEvent inWorld(const TreadEvent& message) const;
  GrassEvent treadEvent(const grass::TreadInput& input) const;
  /// Event of discs that have their places at its tick.
  static GrassEvent coloursEvent(const grass::ColourMasks& colours);

  // Time.
  void tick(std::int64_t tick) override;
  void apply(GrassEvent& event) override;
  /// Successive treads are sorted by their sources: all shards apply those of one tick in the same
  /// order, from whichever nodes and however late they come.
  void arrange(std::vector<GrassEvent>& events) const override;
  void applyToGround(const GrassEvent& event);
  void colourAsInScenario(Nanoseconds stamp);
  void applyTuning(GrassTuning tuning);
  void resetGround();
  void restart(Nanoseconds now) override;
  void onRecovered(const GrassEvent& event) override;

  // Snapshots.
  std::uint64_t sceneHash() const override;
  std::uint64_t stateHash() const override;
  void writeState(Archive& a) const override;
  CheckedState readState(Archive& a) override;

  // Outputs.
  void publishLayout();
  void setColours(grass::ColourMasks colours);
  void publishState(std::int64_t tick);
  void publishNear(const grass::TreadUpdate& update);
  void publishEntering(Nanoseconds stamp);
  GrassForces forcesAt(Nanoseconds stamp) const;
  void publishForces(Nanoseconds stamp);
  void sendCover();
  /// Maps are made at ticks, so that runs repeat, and those of shards at the same ones.
  void sendCoverAt(std::int64_t tick);
  void sendCoverPart();
  const GrassCover& untroddenCover();
  GrassCover makeCover();
  void publishCover(GrassCover cover);
  void followCoverParts(bool is_wanted);
  void onCoverPart(const GrassCoverPart& message);
  void addDiagnostics(Status& status) override;
  void addGovernor(Status& status) override;
  std::vector<PredictedError> predictErrors() const override;

  // Services, and which shards answer requests; routes run in threads of ShardRequests.
  void connectServices();
  template <class ServiceRequest>
  std::vector<std::uint32_t> askAllAtOneTick(ServiceRequest& request);
  std::vector<std::uint32_t> ownersOfPoints(const SampleGrass::Request& request);
  bool onTreadPath(Tread::Request& request, Tread::Response& response);
  bool onSample(SampleGrass::Request& request, SampleGrass::Response& response);
  bool onCut(CutGrass::Request& request, CutGrass::Response& response);
  bool onCutting(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool onSetColours(SetGrassColours::Request& request, SetGrassColours::Response& response);
  bool onClear(ClearGrass::Request& request, ClearGrass::Response& response);
  void queuePath(const std::vector<Vec3>& path, const grass::TreadLaw& law, const ros::Time& stamp);
  GrassSample sampleAt(const Vec3& place, Nanoseconds stamp) const;
  std::string shownTopic(const std::string& topic) const;
  /// The ground of this node, or that of all shards.
  const grass::TreadSimulation& shown() const { return whole_ ? whole_->field() : *field_; }
  /// Receives the ground of all shards while views of it have subscribers.
  void followWhole(Nanoseconds stamp);
  bool isCoverWanted() const;

  GrassTuning tuning_;
  std::unique_ptr<grass::TreadMap> tread_;
  std::unique_ptr<grass::TreadSimulation> field_;
  std::unique_ptr<WholeMeadow> whole_;  // of the node that shows the ground of all shards
  wind::Field wind_;
  grass::ColourMasks colours_;
  bool coloured_{false};  // the discs of the scenario are in force, or an event that waits
  std::unique_ptr<GrassMarkers> markers_;
  KeyFrames key_frames_;
  SensorRegistry sensors_;
  InterestRegions near_;         // viewers and sensors
  bool needs_near_frame_{true};  // a listener is new
  std::uint32_t near_sequence_{0};
  GrassSources sources_;
  std::optional<NearTreads> near_treads_;  // those that this shard needs
  CutterFollower cutters_;
  GrassCover untrodden_;             // cover map of the ground at rest, once it is wanted
  std::int64_t cover_period_{-1};    // of the last tick
  std::optional<CoverJoin> covers_;  // of the node that joins the maps of all shards
  ros::Subscriber cover_parts_;      // while the map is wanted

  static constexpr const char* PATH = "path_";
  std::uint64_t paths_{0};  // trodden by service, for the names of their sources
  std::uint64_t state_bytes_{0}, largest_state_{0}, near_bytes_{0};
  std::uint64_t reported_no_memory_{0};  // of TreadCounts, when diagnostics were last sent
  std::uint64_t reported_uncut_{0};      // nodes that have no memory, likewise
  TreadSenders tread_senders_;
  std::uint64_t unsent_treads_{0};    // senders who were awaited in vain, summed over ticks
  std::uint64_t reported_unsent_{0};  // likewise
  std::uint64_t late_treads_{0};      // of a shard, that came after their tick
  std::uint64_t reported_late_{0};    // of them, likewise

  ros::Publisher layout_publisher_, state_publisher_, near_publisher_, wrenches_publisher_,
      forces_publisher_, cover_publisher_, cover_part_publisher_, values_publisher_,
      colours_publisher_;
  std::array<ros::Publisher, COVER_LAYERS.size()> layer_publishers_;
};

}  // namespace vegetation_sim
