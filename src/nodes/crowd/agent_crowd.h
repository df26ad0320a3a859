// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <tf2_ros/transform_broadcaster.h>
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdBorder.h>
#include <vegetation_sim/CrowdEvent.h>
#include <vegetation_sim/CrowdPart.h>
#include <vegetation_sim/FindAgents.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/NearAgents.h>
#include <vegetation_sim/RemoveAgents.h>
#include <vegetation_sim/SensorInterest.h>
#include <vegetation_sim/SetAgentGoal.h>
#include <vegetation_sim/SpawnAgents.h>
#include <vegetation_sim/TreadEvents.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lod/interest_regions.h"
#include "crowd/agents/crowd_shard.h"
#include "nodes/base/event_node.h"
#include "nodes/crowd/cover_wait.h"
#include "nodes/crowd/crowd_options.h"
#include "nodes/crowd/crowd_robots.h"
#include "nodes/crowd/shards/border_inbox.h"
#include "nodes/crowd/shards/part_join.h"
#include "nodes/listeners/sensor_registry.h"
#include "nodes/markers/crowd_markers.h"
#include "ros/replicas/hashed_cache.h"

namespace vegetation_sim {

/// People on ROS: steps crowd::Crowd on the tick grid of ROS time, publishes where they are and
/// what they tread, answers services.
class AgentCrowd final : public EventNode<EventQueue<CrowdEvent>, AgentCrowdConfig, CrowdOptions> {
 public:
  /// @throws InvalidInput for invalid parameters or an invalid scenario.
  AgentCrowd(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~AgentCrowd() override { stop(); }

 private:
  // Inputs.
  void connect() override;
  void onLayout(const ForestLayout& message);
  void onCover(const nav_msgs::OccupancyGrid& message);
  void awaitCover(Nanoseconds stamp);
  /// Whether the newest cover map of this tick or an earlier one has come, or none is to come.
  bool hasCoverOf(Nanoseconds tick) const;
  void onSensor(const SensorInterest& message);
  void showTuning(AgentCrowdConfig& config) const override { toConfig(options_.tuning, config); }
  CrowdEvent tuningEvent(const AgentCrowdConfig& config) const override;
  bool isOutdated(const CrowdEvent& event, Nanoseconds now) const override;
  void followRobots(Nanoseconds stamp);
  /// Queues an event that names a message by its hash.
  /// @param stamp of the tick at which it acts; 0: the next one.
  void enqueueHash(std::uint8_t kind, std::uint64_t hash, Nanoseconds stamp = 0);

  // Time.
  static constexpr std::uint8_t BORDER = 10;  // kind of events: see CrowdEvent
  void populate(crowd::CrowdShard::Start start);
  void updateNextId();
  /// Number of walkers that wait for their stamps.
  std::size_t waitingWalkers() const;
  void tick(std::int64_t tick) override;
  void publishBeginning(Nanoseconds stamp);
  void apply(CrowdEvent& event) override;
  /// Walls and trunks, and the resistance of grass.
  struct Surroundings {
    std::vector<crowd::Obstacle> obstacles;
    std::size_t trunks{0};
    crowd::Resistance resistance;
  };
  /// @param layout, cover: null for none. @throws InvalidInput for invalid ones.
  Surroundings surroundingsOf(const ForestLayout* layout,
                              const nav_msgs::OccupancyGrid* cover) const;
  void surround(const Surroundings& around);
  void applyTrunks(std::uint64_t hash);
  void applyCover(std::uint64_t hash);
  bool isLaterCover(std::uint64_t hash, Nanoseconds now) const;
  /// Drops a cover map whose stamp is later than the clock, which has jumped back.
  void forgetLaterCover(Nanoseconds now);
  void resetCrowd(crowd::CrowdShard::Start start);
  void restart(Nanoseconds now) override;
  void onRecovered(const CrowdEvent&) override { updateNextId(); }

  // Snapshots.
  std::uint64_t sceneHash() const override;
  std::uint64_t stateHash() const override { return crowd_.snapshot().hash(); }
  void writeState(Archive& a) const override;
  CheckedState readState(Archive& a) override;
  void queueNewerInputs();
  std::string inputOf(const CrowdEvent& event) const override;
  std::function<void()> readInput(CrowdEvent& event, const std::string& bytes,
                                  Nanoseconds shift) override;
  void awaitInputsToSave() override;

  // Shards.
  std::uint64_t scenarioHash() const;
  /// That, and the people of the scenario.
  std::uint64_t peopleHash() const;
  void connectServices();
  std::vector<std::uint32_t> ownersOfPlace(const SpawnAgents::Request& request);
  /// Returns the shards that answer, and fills in `ids` for all. @throws InvalidInput as a single
  /// node would, and for people whom a silent shard may have.
  std::vector<std::uint32_t> findOwners(FindAgents::Request& request);
  bool onFind(FindAgents::Request& request, FindAgents::Response& response);
  bool isForThisShard(const CrowdEvent& event);
  std::vector<std::uint32_t> allIds() const;
  std::uint32_t takeId();
  void hearBorders(Nanoseconds stamp);
  bool isAnyRunningShardSilent();
  void applyBorder(std::uint64_t hash);
  void beginTickOfShard();
  void endTickOfShard();
  void keepBorder(const crowd::CrowdBorder& after_tick);
  void publishBorder();
  void onPart(const CrowdPart& message);
  void joinPart(const CrowdPart& part);
  void publishJoined(const AgentStates& all);

  // Outputs.
  AgentStates agentsAt(Nanoseconds stamp) const;
  void publishPart(Nanoseconds stamp);
  void publishAgents(Nanoseconds stamp);
  void publishNear(const AgentStates& all);
  void publishView(Nanoseconds stamp);
  void sendView(const std::vector<crowd::Walker>& walkers, Nanoseconds stamp);
  void publishMotions();
  void publishTreads();
  /// Stamp at which the treads of a tick act.
  Nanoseconds stampOfTreads(std::int64_t tick) const;
  /// Returns the message of the last tick, without its treads.
  TreadEvents emptyTreads() const;
  /// Whether ticks await the cover maps of a meadow, and those of the meadow these treads.
  bool awaitsMeadow() const {
    return options_.frame_wait > 0.0 && options_.cover_rate > 0.0 && !options_.replay;
  }
  void treadOfBody(const crowd::Walker& walker, Nanoseconds stamp, TreadEvents& treads);
  void treadOfFeet(const crowd::Walker& walker, Nanoseconds stamp, TreadEvents& treads);
  std::vector<TierChoice> chooseFrames(Nanoseconds stamp);
  void sendFrames();
  /// Name of a walker's frame, and of the source by which it treads.
  std::string nameOf(const crowd::Walker& walker) const;
  void addDiagnostics(Status& status) override;
  void addGovernor(Status& status) override;
  /// Largest effect of the rounding of `agents/view` on limbs [m].
  double viewError() const;
  std::vector<PredictedError> predictErrors() const override;

  // Services.
  bool onSpawn(SpawnAgents::Request& request, SpawnAgents::Response& response);
  bool onRemove(RemoveAgents::Request& request, RemoveAgents::Response& response);
  bool onSetGoal(SetAgentGoal::Request& request, SetAgentGoal::Response& response);
  static void checkNumber(const std::vector<std::uint32_t>& ids, Faults& faults);
  static void addUnknown(std::uint32_t id, Faults& faults);
  /// The place of a request in the world frame. @param to_world pose of its frame.
  static crowd::Point placeInWorld(const geometry_msgs::Point& point, const Pose& to_world);
  /// @throws InvalidInput for ids that no walker has; in a shard those asked for are known.
  void checkKnown(const std::vector<std::uint32_t>& ids) const;
  /// Leaves the ids of those whom this shard may have at the next tick. Returns the number of those
  /// whom it has now.
  std::size_t keepOwn(std::vector<std::uint32_t>& ids) const;
  /// Queues an event for each of the ids. @throws InvalidInput, before any, if they have no room.
  void enqueueEach(CrowdEvent event, const std::vector<std::uint32_t>& ids);

  crowd::Crowd crowd_;
  std::optional<crowd::CrowdShard> shard_;
  std::unique_ptr<BorderInbox> inbox_;  // null without other shards
  std::uint64_t reported_dropped_{0};   // borders, on /diagnostics
  HashedCache<CrowdBorder> borders_;
  std::unique_ptr<PartJoin> parts_;       // null unless this node joins them
  std::vector<std::uint32_t> heard_now_;  // shards whose borders have come since the tick before
  ros::Subscriber parts_subscriber_;      // of the node that joins them
  CrowdMarkers markers_;
  CrowdRobots robots_;
  SensorRegistry sensors_;
  InterestRegions near_sensors_, near_viewers_;
  std::uint32_t next_id_{0};  // of the next walker that a request adds
  HashedCache<ForestLayout> layouts_;
  HashedCache<nav_msgs::OccupancyGrid> covers_;
  ros::Subscriber covers_subscriber_;
  CoverWait cover_wait_;
  std::uint64_t unsent_covers_{0}, reported_unsent_{0};  // awaited in vain; on /diagnostics
  std::uint64_t trunks_hash_{0}, cover_hash_{0};         // of the messages in force; 0: none
  std::uint64_t heard_layout_{0}, heard_cover_{0};       // of the newest ones
  bool is_first_tick_{true};                             // of the process
  bool begun_{false};  // a tick was done since the start or the last jump back
  std::size_t trunks_{0};
  TierHysteresis held_frames_;   // 1: has one
  std::size_t frames_sent_{0};   // at the last round
  Nanoseconds frames_stamp_{0};  // of the last round
  struct Trodden {
    crowd::Point place{};
    bool stood[2]{true, true};
    bool seen{false};
  };
  using Walked = std::map<std::uint32_t, Trodden>;  // by walker
  static void archive(Archive& a, Walked& walked);
  /// Returns what is sent of a border: people, and where those who have crossed it have trodden.
  std::string archiveBorder(const crowd::CrowdBorder& border) const;
  /// @throws InvalidInput for bytes that are none.
  static std::pair<crowd::CrowdBorder, Walked> readBorder(std::string bytes);
  struct SentBorder {
    Nanoseconds stamp{0};
    std::string bytes{};
  };
  static void archive(Archive& a, SentBorder& border);
  SentBorder border_, previous_border_;  // of the last two ticks
  Walked trodden_;
  std::uint64_t treads_{0}, state_bytes_{0}, view_bytes_{0}, near_bytes_{0};

  tf2_ros::TransformBroadcaster tf_broadcaster_;
  ros::Publisher agents_publisher_, near_publisher_, view_publisher_, motions_publisher_,
      treads_publisher_, border_publisher_, parts_publisher_;
};

}  // namespace vegetation_sim
