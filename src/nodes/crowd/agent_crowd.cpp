// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/agent_crowd.h"

#include "nodes/base/node_factory.h"

#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdMotions.h>
#include <vegetation_sim/CrowdView.h>

#include "core/config/field_values.h"
#include "nodes/crowd/crowd_events.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr unsigned MOST_COVERS = 16;   // maps that wait for their ticks
constexpr double TRUNK_MARGIN = 30.0;  // around the area [m]
constexpr double SHORTEST_WAIT = 0.2;  // for the borders of other shards, wall time [s]

}  // namespace

AgentCrowd::AgentCrowd(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : EventNode("agent_crowd", "agents/events", handle, private_handle,
                loadCrowdOptions(private_handle)),
      crowd_(options_.scene.seed, options_.tuning, options_.scene.crowd.area,
             options_.scene.terrain),
      markers_(crowd_, options_.marker_points, options_.tolerance, options_.motions,
               options_.shard.value_or(Shard())),
      robots_(options_.frame_id, options_.robots, tf_buffer_, options_.frame_wait),
      covers_(MOST_COVERS),
      cover_wait_(options_.cover_rate, options_.state_rate) {
  crowd_.setThreads(options_.threads);
  crowd_.setObstacles(obstaclesOf(options_.scene.crowd.walls));
  join("crowd", listMessages<AgentStates, CrowdBorder, CrowdPart>(), peopleHash(),
       options_.scene.terrain->hash());
  if (options_.shard) shard_.emplace(crowd_, *options_.shard);
  populate(crowd::CrowdShard::Start::FRESH);
  if (isPart()) {
    borders_ = HashedCache<CrowdBorder>(2 * std::size_t{options_.shard->count});
    const auto is_from_shard = [this](std::uint32_t shard, const std::string& process) {
      bool is_accepted = false;
      acceptInput("agents/border", [&] {
        shards()->registry().checkSender(shard, process);
        is_accepted = true;
      });
      return is_accepted;
    };
    inbox_ = std::make_unique<BorderInbox>(
        handle_, *options_.shard, std::max(SHORTEST_WAIT, options_.frame_wait), is_from_shard);
    border_publisher_ = handle_.advertise<CrowdBorder>("agents/border", 100, true);
    if (showsAll())
      parts_ = std::make_unique<PartJoin>(options_.shard->count, options_.shard->index);
  }
  if (showsAll()) {
    agents_publisher_ = handle_.advertise<AgentStates>("agents", 100);
    near_publisher_ = handle_.advertise<NearAgents>("agents/near", 100);
    view_publisher_ = handle_.advertise<CrowdView>("agents/view", 100);
    motions_publisher_ = handle_.advertise<CrowdMotions>("agents/motions", 1, true);
    publishMotions();
  } else {
    parts_publisher_ = handle_.advertise<CrowdPart>("agents/parts", 100);
  }
  treads_publisher_ = handle_.advertise<TreadEvents>(
      "treads", 1000, [this](const ros::SingleSubscriberPublisher& subscriber) {
        if (awaitsMeadow() && options_.tread != Treading::NONE) subscriber.publish(emptyTreads());
      });
  start("crowd", "agents/markers", markers_);
  publishBorder();
}

void AgentCrowd::connect() {
  subscribeToShardedOwner("forest/layout", 4, &AgentCrowd::onLayout, "forest/shards");
  covers_subscriber_ = subscribeToOwner("grass/cover/resistance", MOST_COVERS, &AgentCrowd::onCover,
                                        awaitsMeadow() ? Delivery::AWAITED : Delivery::AT_ONCE);
  if (showsAll()) subscribe("forest/sensors", 40, &AgentCrowd::onSensor);
  if (isPart() && showsAll())
    parts_subscriber_ = subscribeToShards("agents/parts", 1000, &AgentCrowd::onPart);
  connectServices();
  repeat(options_.tf_rate, &AgentCrowd::sendFrames);
}

// Walkers of the scenario exist from the first tick on, so they are no events.
void AgentCrowd::populate(crowd::CrowdShard::Start start) {
  std::uint32_t id = 0;
  for (const crowd::Spawn& spawn : options_.scene.crowd.spawns) crowd_.spawn(spawn, id++);
  updateNextId();
  if (shard_) keepBorder(shard_->begin(start));
}

// Ids of walkers that wait for their stamps are taken too.
void AgentCrowd::updateNextId() {
  next_id_ = std::max(crowd_.snapshot().next_id,
                      static_cast<std::uint32_t>(options_.scene.crowd.spawns.size()));
  inputs_.each([this](const CrowdEvent& event) {
    if (event.kind == CrowdEvent::SPAWN) next_id_ = std::max(next_id_, event.id + 1);
  });
}

std::size_t AgentCrowd::waitingWalkers() const {
  std::size_t out = 0;
  inputs_.each([&](const CrowdEvent& event) { out += event.kind == CrowdEvent::SPAWN; });
  return out;
}

void AgentCrowd::tick(std::int64_t) {
  const Nanoseconds stamp = clock_.stamp();
  if (!begun_ && !options_.replay) publishBeginning(stamp);
  begun_ = true;
  if (recovers()) cover_wait_.onLoaded(stamp);
  if (!options_.replay) {
    awaitCover(stamp);
    followRobots(stamp);
    hearBorders(stamp);
  }
  applyInputs(stamp);
  beginTickOfShard();
  updateNextId();
  crowd_.advance(stamp);
  publishAgents(stamp);
  publishView(stamp);
  publishTreads();
  endTickOfShard();
}

// A replay resets itself at the beginning of this run by this event.
void AgentCrowd::publishBeginning(Nanoseconds stamp) {
  CrowdEvent event;
  event.kind = CrowdEvent::RESET;
  event.header.stamp = toStamp(stamp);
  publishEvent(event);
}

void AgentCrowd::apply(CrowdEvent& event) {
  switch (event.kind) {
    case CrowdEvent::TRUNKS:
      applyTrunks(event.input_hash);
      break;
    case CrowdEvent::COVER:
      applyCover(event.input_hash);
      break;
    case CrowdEvent::SETTINGS: {
      auto settings = fromNamedValues<crowd::CrowdSettings>({event.names, event.values});
      settings.behaviour = options_.tuning.behaviour;
      settings.noise = options_.tuning.noise;
      crowd_.setSettings(settings);
      break;
    }
    case CrowdEvent::RESET:
      if (shard_) shard_->setRun(shard_->run() + 1);
      resetCrowd(crowd::CrowdShard::Start::RESET);
      break;
    case BORDER:
      applyBorder(event.input_hash);
      break;
    default:
      if (!isPart() || isForThisShard(event)) applyToCrowd(event, crowd_);
  }
}

void AgentCrowd::applyTrunks(std::uint64_t hash) {
  const ForestLayout* found = layouts_.find(hash);
  if (!found)
    throw InvalidInput("input_hash = " + std::to_string(hash) +
                       " matches no forest layout received");
  const Surroundings around = surroundingsOf(found, nullptr);
  trunks_ = around.trunks;
  trunks_hash_ = hash;
  crowd_.setObstacles(around.obstacles);
}

AgentCrowd::Surroundings AgentCrowd::surroundingsOf(const ForestLayout* layout,
                                                    const nav_msgs::OccupancyGrid* cover) const {
  Surroundings out;
  out.obstacles = obstaclesOf(options_.scene.crowd.walls);
  if (cover) out.resistance = resistanceOf(*cover);
  if (!layout) return out;
  const std::vector<crowd::Obstacle> trunks =
      trunksOf(fromMsg(*layout), options_.trunks, options_.scene.crowd.area, TRUNK_MARGIN,
               static_cast<std::size_t>(options_.most_trunks));
  out.trunks = trunks.size();
  out.obstacles.insert(out.obstacles.end(), trunks.begin(), trunks.end());
  return out;
}

void AgentCrowd::surround(const Surroundings& around) {
  trunks_ = around.trunks;
  crowd_.setObstacles(around.obstacles);
  crowd_.setResistance(around.resistance);
}

void AgentCrowd::applyCover(std::uint64_t hash) {
  const nav_msgs::OccupancyGrid* found = covers_.find(hash);
  if (!found)
    throw InvalidInput("input_hash = " + std::to_string(hash) + " matches no cover received");
  crowd_.setResistance(resistanceOf(*found));
  cover_hash_ = hash;
}

// Trunks, grass and settings stay in force.
void AgentCrowd::resetCrowd(crowd::CrowdShard::Start start) {
  crowd_.clear();
  populate(start);
  robots_.clear();
  trodden_.clear();
}

bool AgentCrowd::isLaterCover(std::uint64_t hash, Nanoseconds now) const {
  const nav_msgs::OccupancyGrid* cover = covers_.find(hash);
  return cover != nullptr && fromMsg(cover->header.stamp) >= now;
}

// The meadow that has sent it starts afresh too.
void AgentCrowd::forgetLaterCover(Nanoseconds now) {
  if (isLaterCover(heard_cover_, now)) heard_cover_ = 0;
  if (!isLaterCover(cover_hash_, now)) return;
  cover_hash_ = 0;
  crowd_.setResistance({});
}

bool AgentCrowd::isOutdated(const CrowdEvent& event, Nanoseconds now) const {
  return event.kind <= CrowdEvent::REMOVE_ROBOT ||
         (event.kind == CrowdEvent::COVER && isLaterCover(event.input_hash, now));
}

void AgentCrowd::restart(Nanoseconds now) {
  resetCrowd(crowd::CrowdShard::Start::FRESH);
  forgetLaterCover(now);
  cover_wait_.jumpBack();
  if (inbox_) inbox_->jumpBack();
  if (parts_) parts_->jumpBack();
  sensors_.clear();
  publishBorder();
  begun_ = false;
}

std::shared_ptr<void> createAgentCrowd(const ros::NodeHandle& handle,
                                       const ros::NodeHandle& private_handle) {
  return std::make_shared<AgentCrowd>(handle, private_handle);
}

}  // namespace vegetation_sim
