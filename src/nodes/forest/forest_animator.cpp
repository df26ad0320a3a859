// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_animator.h"

#include <tf2/exceptions.h>

#include <algorithm>

#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_VIEWERS = 32;

forest::Layout designed(const forest::Layout& layout, const ForestTuning& tuning) {
  forest::Layout out = layout;
  for (forest::Species& species : out.species) species = applyDesign(species, tuning.design);
  out.motion.transition = tuning.transition;
  return out;
}

}  // namespace

ForestAnimator::ForestAnimator(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      options_(loadForestOptions(private_handle, scene_)),
      tuning_(options_.tuning),
      inputs_(options_.replay),
      cache_(static_cast<std::size_t>(options_.cache_budget)),
      frames_(options_.tf_budget),
      markers_(options_.marker_points),
      tf_listener_(tf_buffer_),
      clock_("forest_animator", options_.state_rate, options_.replay ? options_.replay_delay : 0.0,
             {[this] { lookFromFrame(); }, [this](std::int64_t tick) { this->tick(tick); },
              [this](Nanoseconds now) { restart(now); }}),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  forest_ = std::make_unique<forest::Forest>(designed(scene_.layout, tuning_), scene_.terrain,
                                             tuning_.settings);
  forest_->setPhysics(scene_.physics);
  forest_->precompute();
  grabs_manager_ = std::make_unique<GrabManager>(
      GrabDependencies{options_, *forest_, cache_, inputs_, tf_buffer_});
  layout_publisher_ = handle_.advertise<ForestLayout>("forest/layout", 1, true);
  state_publisher_ = handle_.advertise<ForestState>("forest/state", 1000);
  branches_publisher_ = handle_.advertise<BranchTransforms>("forest/branches", 60);
  markers_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("forest/markers", 1);
  events_publisher_ = handle_.advertise<ForestEvent>("forest/events", 1000);
  bodies_ = std::make_unique<RobotBodies>(handle_, options_.frame_id, options_.robot.parts);
  wrenches_publisher_ = handle_.advertise<geometry_msgs::WrenchStamped>("forest/wrenches", 1000);
  publishLayout();
  diagnostics_.setHardwareID("none");
  diagnostics_.add("forest", this, &ForestAnimator::diagnose);
  diagnostics_.add("governor", this, &ForestAnimator::diagnoseGovernor);
  // The server writes its values back to the parameters: they are the checked ones by then.
  tuning_server_ =
      std::make_unique<dynamic_reconfigure::Server<ForestAnimatorConfig>>(private_handle_);
  tuning_server_->setCallback(
      [this](ForestAnimatorConfig& config, std::uint32_t) { onTuning(config); });
  listen();
}

// Last of all: the first callbacks of a nodelet may come while it is still being built.
void ForestAnimator::listen() {
  subscribers_ = {handle_.subscribe("wind", 10, &ForestAnimator::onWind, this)};
  subscribers_.push_back(options_.replay
                             ? handle_.subscribe("forest/events", ForestInputs::MOST_WAITING,
                                                 &ForestAnimator::onEvent, this)
                             : handle_.subscribe("viewer", 10, &ForestAnimator::onViewer, this));
  services_ = {private_handle_.advertiseService("get_tree", &ForestAnimator::onGetTree, this),
               private_handle_.advertiseService("pick", &ForestAnimator::onPick, this),
               private_handle_.advertiseService("set_tf", &ForestAnimator::onSetTf, this),
               private_handle_.advertiseService("grab", &ForestAnimator::onGrab, this),
               private_handle_.advertiseService("move_grab", &ForestAnimator::onMoveGrab, this),
               private_handle_.advertiseService("release", &ForestAnimator::onRelease, this),
               private_handle_.advertiseService("apply_force", &ForestAnimator::onApplyForce, this),
               private_handle_.advertiseService("reset", &ForestAnimator::onReset, this)};
  const auto every = [this](double rate, void (ForestAnimator::*call)(const ros::TimerEvent&)) {
    timers_.push_back(handle_.createTimer(ros::Duration(1.0 / rate), call, this));
  };
  every(options_.tf_rate, &ForestAnimator::sendFrames);
  every(options_.branches_rate, &ForestAnimator::sendBranches);
  every(options_.markers_rate, &ForestAnimator::sendMarkers);
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  clock_.listen(handle_);
}

// What a fresh start now would be, with the layout, wind and settings that are in force.
void ForestAnimator::startAnew() {
  forest_->reset();
  frames_.clear();
  deepest_ = {};
  force_key_frame_ = true;
}

void ForestAnimator::restart(Nanoseconds now) {
  startAnew();
  inputs_.startAnew(now);
  grabs_manager_->clear(true);
  bodies_->clear();
  tf_buffer_.clear();
  last_framed_.reset();
  publishLayout();
}

void ForestAnimator::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!options_.replay) followBodies(stamp);
  grabs_manager_->follow(
      stamp, [this](const std::string& what, const std::string& why) { refusals_.add(what, why); });
  for (ForestEvent& event : inputs_.take(stamp)) {
    event.header.frame_id = options_.frame_id;
    try {
      grabs_manager_->aim(event);
      apply(event);
      grabs_manager_->applyDelta(event);
      if (!options_.replay) events_publisher_.publish(event);
    } catch (const InvalidInput& error) {
      grabs_manager_->drop(event);
      refusals_.add("event", error.what());
    }
  }
  warnOfLosses("forest_animator", inputs_.losses(), published_);
  forest_->advance(stamp);
  noteOverlaps();
  const auto period = static_cast<std::int64_t>(options_.key_frame_period * options_.state_rate);
  const bool key_frame = force_key_frame_ || tick % std::max<std::int64_t>(1, period) == 0;
  ForestState message = toMsg(forest_->update(key_frame));
  message.header.frame_id = options_.frame_id;
  counts_.state_bytes += ros::serialization::serializationLength(message);
  state_publisher_.publish(message);
  settleGrabs();
  force_key_frame_ = false;
}

void ForestAnimator::apply(const ForestEvent& event) {
  switch (event.kind) {
    case ForestEvent::VIEWER: {
      forest::Viewer viewer = fromMsg(event.viewer);
      viewer.stamp = fromMsg(event.header.stamp);
      const auto& known = forest_->snapshot().viewers;
      if (known.size() >= MOST_VIEWERS && !known.count(viewer.id))
        throw InvalidInput("viewer '" + viewer.id + "' is one more than the " +
                           std::to_string(MOST_VIEWERS) + " allowed at once");
      forest_->setViewer(viewer);
      break;
    }
    case ForestEvent::WIND: {
      const auto wind = inputs_.windOf(event);
      if (!wind)
        throw InvalidInput("wind_hash = " + std::to_string(event.wind_hash) +
                           " is of no wind that was heard");
      forest_->setWind(*wind);
      break;
    }
    case ForestEvent::SETTINGS:
      adoptTuning(tuningOf(event));
      break;
    case ForestEvent::RESET:
      startAnew();
      break;
    default:
      applyInteraction(event);
  }
}

void ForestAnimator::applyInteraction(const ForestEvent& event) {
  switch (event.kind) {
    case ForestEvent::GRAB:
      forest_->addGrab(fromMsg(event.grab));
      break;
    case ForestEvent::MOVE:
      forest_->moveGrab(event.grab.id, fromMsg(event.grab.target));
      break;
    case ForestEvent::RENEW:
      forest_->renewGrab(event.grab.id);
      break;
    case ForestEvent::RELEASE:
      forest_->release(event.grab.id);
      break;
    case ForestEvent::FORCE:
      forest_->push(fromMsg(event.force, fromMsg(event.header.stamp)));
      break;
    case ForestEvent::BODY:
      forest_->setBody(fromMsg(event.body));
      break;
    case ForestEvent::REMOVE_BODY:
      forest_->removeBody(event.body.id);
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 10");
  }
}

// Bodies that have moved or appeared, and those whose frame tf no longer tells.
void ForestAnimator::followBodies(Nanoseconds stamp) {
  const std::vector<forest::Body> now = bodies_->update(stamp);
  const auto& known = forest_->bodies();
  ForestEvent event;
  event.kind = ForestEvent::BODY;
  for (const RobotPart& part : options_.robot.parts) {
    const auto body = std::find_if(now.begin(), now.end(),
                                   [&](const forest::Body& b) { return b.id == part.body.id; });
    const auto old = known.find(part.body.id);
    if (body != now.end() && (old == known.end() || old->second.stamp != body->stamp)) {
      event.body = toMsg(*body, part.in_frame);
      inputs_.addFirst(event);
    } else if (body == now.end() && old != known.end()) {
      ForestEvent gone;
      gone.kind = ForestEvent::REMOVE_BODY;
      gone.body.id = part.body.id;
      inputs_.addFirst(gone);
    }
  }
}

void ForestAnimator::settleGrabs() {
  for (const forest::Grab& grab : grabs_manager_->settle()) {
    ++counts_.leases_ended;
    ROS_WARN("forest_animator: grab %u ended: nobody moved or renewed it for its lease of %g s",
             grab.id, grab.lease);
  }
  for (const geometry_msgs::WrenchStamped& wrench : grabs_manager_->wrenches())
    wrenches_publisher_.publish(wrench);
}

void ForestAnimator::adoptTuning(const ForestTuning& tuning) {
  forest::Layout layout = designed(scene_.layout, tuning);
  layout.terrain_hash = scene_.terrain->hash();
  const bool same = layout.hash() == forest_->layoutHash();
  if (!same) {
    forest_->setLayout(std::move(layout), scene_.terrain);
    forest_->precompute();
  }
  forest_->setSettings(tuning.settings);
  tuning_ = tuning;
  if (same) return;
  cache_.clear();
  markers_.reset();
  force_key_frame_ = true;
  publishLayout();
}

void ForestAnimator::publishLayout() {
  ForestLayout message = toMsg(forest_->layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
}

}  // namespace vegetation_sim
