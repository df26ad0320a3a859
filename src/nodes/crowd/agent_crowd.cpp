// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/agent_crowd.h"

#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/TreadEvent.h>

#include "core/config/field_values.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double TRUNK_MARGIN = 30.0;  // around the area [m]

}  // namespace

AgentCrowd::AgentCrowd(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      options_(loadCrowdOptions(private_handle, scene_)),
      inputs_(options_.replay),
      markers_(options_.marker_points),
      tf_listener_(tf_buffer_),
      clock_("agent_crowd", options_.state_rate, options_.replay ? options_.replay_delay : 0.0,
             {{},
              [this](std::int64_t tick) { this->tick(tick); },
              [this](Nanoseconds now) { restart(now); }}),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  crowd_ = std::make_unique<crowd::Crowd>(scene_.seed, options_.tuning, scene_.crowd.area,
                                          scene_.terrain);
  crowd_->setThreads(options_.threads);
  crowd_->setObstacles(obstaclesOf(scene_.crowd.walls));
  populate();
  robots_ = std::make_unique<CrowdRobots>(options_.frame_id, options_.robots, tf_buffer_);
  agents_publisher_ = handle_.advertise<AgentStates>("agents", 100);
  tread_publisher_ = handle_.advertise<TreadEvent>("tread", 10000);
  markers_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("agents/markers", 1);
  events_publisher_ = handle_.advertise<CrowdEvent>("agents/events", 10000);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("crowd", this, &AgentCrowd::diagnose);
  diagnostics_.add("governor", this, &AgentCrowd::diagnoseGovernor);
  tuning_server_ = std::make_unique<dynamic_reconfigure::Server<AgentCrowdConfig>>(private_handle_);
  tuning_server_->setCallback(
      [this](AgentCrowdConfig& config, std::uint32_t) { onTuning(config); });
  listen();
}

// Last of all: the first callbacks of a nodelet may come while it is still being built.
void AgentCrowd::listen() {
  constexpr unsigned MANY = 2 * EventQueue<CrowdEvent>::MOST_WAITING;
  subscribers_ = {handle_.subscribe("forest/layout", 4, &AgentCrowd::onLayout, this),
                  handle_.subscribe("grass/cover/resistance", 4, &AgentCrowd::onCover, this),
                  handle_.subscribe("viewer", 10, &AgentCrowd::onViewer, this)};
  if (options_.replay)
    subscribers_.push_back(handle_.subscribe("agents/events", MANY, &AgentCrowd::onEvent, this));
  services_ = {private_handle_.advertiseService("spawn", &AgentCrowd::onSpawn, this),
               private_handle_.advertiseService("remove", &AgentCrowd::onRemove, this),
               private_handle_.advertiseService("set_goal", &AgentCrowd::onSetGoal, this),
               private_handle_.advertiseService("reset", &AgentCrowd::onReset, this)};
  timers_ = {
      handle_.createTimer(ros::Duration(1.0 / options_.markers_rate), &AgentCrowd::sendMarkers,
                          this),
      handle_.createTimer(ros::Duration(1.0 / options_.tf_rate), &AgentCrowd::sendFrames, this)};
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  clock_.listen(handle_);
}

// The scenario's people are there from the first tick on, so they are no events.
void AgentCrowd::populate() {
  for (const crowd::Spawn& spawn : scene_.crowd.spawns) crowd_->spawn(spawn);
  keepPromises();
}

// No id is told twice, whether its walker is here or still waits for its stamp.
void AgentCrowd::keepPromises() {
  promised_ = crowd_->snapshot().next_id;
  inputs_.each([this](const CrowdEvent& event) {
    if (event.kind == CrowdEvent::SPAWN) promised_ = std::max(promised_, event.id + 1);
  });
}

std::size_t AgentCrowd::awaited() const {
  std::size_t out = 0;
  inputs_.each([&](const CrowdEvent& event) { out += event.kind == CrowdEvent::SPAWN; });
  return out;
}

void AgentCrowd::tick(std::int64_t) {
  const Nanoseconds stamp = clock_.stamp();
  if (!begun_ && !options_.replay) publishBeginning(stamp);
  begun_ = true;
  if (!options_.replay) followRobots(stamp);
  for (CrowdEvent& event : inputs_.take(stamp)) {
    event.header.frame_id = options_.frame_id;
    try {
      apply(event);
      ++counts_.events;
      if (!options_.replay) events_publisher_.publish(event);
    } catch (const InvalidInput& error) {
      refusals_.add("event", error.what());
    }
  }
  warnOfLosses("agent_crowd", inputs_.losses(), published_);
  keepPromises();
  crowd_->advance(stamp);
  publishAgents(stamp);
  publishTreads(stamp);
}

// A replay does not know when this run began: it begins anew then.
void AgentCrowd::publishBeginning(Nanoseconds stamp) {
  CrowdEvent event;
  event.kind = CrowdEvent::RESET;
  event.header.stamp = toStamp(stamp);
  event.header.frame_id = options_.frame_id;
  events_publisher_.publish(event);
}

void AgentCrowd::apply(const CrowdEvent& event) {
  switch (event.kind) {
    case CrowdEvent::ROBOT:
      crowd_->setRobot(fromMsg(event.robot));
      break;
    case CrowdEvent::REMOVE_ROBOT:
      crowd_->removeRobot(event.robot.id);
      break;
    case CrowdEvent::TRUNKS:
      adoptTrunks(event.input_hash);
      break;
    case CrowdEvent::COVER:
      adoptCover(event.input_hash);
      break;
    case CrowdEvent::SETTINGS: {
      auto settings = fromNamedValues<crowd::CrowdSettings>({event.names, event.values});
      settings.behaviour = options_.tuning.behaviour;
      settings.noise = options_.tuning.noise;
      crowd_->setSettings(settings);
      break;
    }
    case CrowdEvent::RESET:
      startAnew();
      break;
    default:
      applyToWalker(event);
  }
}

void AgentCrowd::applyToWalker(const CrowdEvent& event) {
  switch (event.kind) {
    case CrowdEvent::SPAWN:
      crowd_->spawn(fromMsg(event.spawn), event.id);
      break;
    case CrowdEvent::REMOVE:
      crowd_->remove(event.id);
      break;
    case CrowdEvent::GOAL:
      if (event.spawn.has_goal)
        crowd_->setGoal(event.id, {event.spawn.goal.x, event.spawn.goal.y});
      else
        crowd_->setWandering(event.id);
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 8");
  }
}

void AgentCrowd::adoptTrunks(std::uint64_t hash) {
  const ForestLayout* found = layouts_.find(hash);
  if (!found)
    throw InvalidInput("input_hash = " + std::to_string(hash) + " is of no forest that was heard");
  std::vector<crowd::Obstacle> all = obstaclesOf(scene_.crowd.walls);
  const std::vector<crowd::Obstacle> trunks =
      trunksOf(fromMsg(*found), static_cast<TrunkShape>(options_.trunks), scene_.crowd.area,
               TRUNK_MARGIN, static_cast<std::size_t>(options_.most_trunks));
  all.insert(all.end(), trunks.begin(), trunks.end());
  trunks_ = trunks.size();
  crowd_->setObstacles(std::move(all));
}

void AgentCrowd::adoptCover(std::uint64_t hash) {
  const nav_msgs::OccupancyGrid* found = covers_.find(hash);
  if (!found)
    throw InvalidInput("input_hash = " + std::to_string(hash) + " is of no cover that was heard");
  crowd_->setResistance(resistanceOf(*found));
}

// What a fresh start now would be, with the trunks, grass and settings that are in force.
void AgentCrowd::startAnew() {
  crowd_->clear();
  populate();
  robots_->clear();
  trodden_.clear();
}

void AgentCrowd::restart(Nanoseconds now) {
  inputs_.forget([&](const CrowdEvent& event) {
    const bool of_walker = event.kind <= CrowdEvent::REMOVE_ROBOT;
    return options_.replay ? fromMsg(event.header.stamp) > now : of_walker;
  });
  startAnew();
  tf_buffer_.clear();
  viewers_.clear();
  begun_ = false;
}

}  // namespace vegetation_sim
