// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/forest_animator.h"

#include <tf2/exceptions.h>

#include <algorithm>

#include "vegetation_sim/ros/forest_conversions.h"
#include "vegetation_sim/ros/wind_conversions.h"

namespace vegetation_sim {
namespace {

// Later than this the ticks between are dropped and counted, not caught up.
constexpr double LONGEST_CATCH_UP = 1.0;  // [s]

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
      options_(loadForestOptions(private_handle)),
      scene_(loadForestScene(options_.scenario)),
      tuning_(options_.tuning),
      inputs_(options_.replay),
      grid_(options_.state_rate),
      cache_(static_cast<std::size_t>(options_.cache_budget)),
      frames_(options_.tf_budget),
      markers_(options_.marker_points),
      tf_listener_(tf_buffer_),
      diagnostics_(handle, private_handle) {
  if (!private_handle_.hasParam("transition")) tuning_.transition = scene_.layout.motion.transition;
  if (!private_handle_.hasParam("frame_id") && !scene_.frame_id.empty())
    options_.frame_id = scene_.frame_id;
  forest_ = std::make_unique<forest::Forest>(designed(scene_.layout, tuning_), scene_.terrain,
                                             tuning_.settings);
  for (const int tree : options_.branches_trees)
    seedOf(forest_->layout(), static_cast<std::uint32_t>(tree));

  layout_publisher_ = handle_.advertise<ForestLayout>("forest/layout", 1, true);
  state_publisher_ = handle_.advertise<ForestState>("forest/state", 60);
  branches_publisher_ = handle_.advertise<BranchTransforms>("forest/branches", 60);
  markers_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("forest/markers", 1);
  events_publisher_ = handle_.advertise<ForestEvent>("forest/events", 1000);
  wind_subscriber_ = handle_.subscribe("wind", 10, &ForestAnimator::onWind, this);
  if (options_.replay)
    events_subscriber_ = handle_.subscribe("forest/events", 1000, &ForestAnimator::onEvent, this);
  else
    viewer_subscriber_ = handle_.subscribe("viewer", 10, &ForestAnimator::onViewer, this);

  services_ = {private_handle_.advertiseService("get_tree", &ForestAnimator::onGetTree, this),
               private_handle_.advertiseService("pick", &ForestAnimator::onPick, this),
               private_handle_.advertiseService("set_tf", &ForestAnimator::onSetTf, this),
               private_handle_.advertiseService("reset", &ForestAnimator::onReset, this)};
  // The server writes its values back to the parameters: they are the checked ones by then.
  tuning_server_ =
      std::make_unique<dynamic_reconfigure::Server<ForestAnimatorConfig>>(private_handle_);
  tuning_server_->setCallback(
      [this](ForestAnimatorConfig& config, std::uint32_t) { onTuning(config); });
  const auto every = [this](double rate, void (ForestAnimator::*call)(const ros::TimerEvent&)) {
    timers_.push_back(handle_.createTimer(ros::Duration(1.0 / rate), call, this));
  };
  every(options_.state_rate, &ForestAnimator::onTick);
  every(options_.tf_rate, &ForestAnimator::sendFrames);
  every(options_.branches_rate, &ForestAnimator::sendBranches);
  every(options_.markers_rate, &ForestAnimator::sendMarkers);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("forest", this, &ForestAnimator::diagnose);
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  publishLayout();
}

void ForestAnimator::onTick(const ros::TimerEvent&) {
  Nanoseconds now = fromMsg(ros::Time::now());
  if (now <= 0) return;  // no clock yet
  if (options_.replay) now -= fromSeconds(options_.replay_delay);
  const std::int64_t due = grid_.tickAt(now);
  if (last_tick_ != NEVER && due < last_tick_) restart();
  if (last_tick_ == NEVER) last_tick_ = due - 1;
  const auto longest = static_cast<std::int64_t>(LONGEST_CATCH_UP * grid_.rate());
  if (due - last_tick_ > longest) {
    counts_.dropped += static_cast<std::uint64_t>(due - last_tick_ - 1);
    last_tick_ = due - 1;
  }
  if (due > last_tick_ && !options_.viewer_frame.empty()) lookFromFrame();
  while (last_tick_ < due) tick(last_tick_ + 1);
}

// Time went backwards: what a fresh start now would be, with the wind that is in force.
void ForestAnimator::restart() {
  ROS_WARN("forest_animator: time went back; starting anew");
  ++counts_.jumps;
  forest_->reset();
  if (!options_.replay) inputs_.clear();
  tf_buffer_.clear();
  last_tick_ = last_key_frame_ = NEVER;
  force_key_frame_ = true;
  publishLayout();
}

void ForestAnimator::tick(std::int64_t tick) {
  const Nanoseconds stamp = grid_.timeOf(tick);
  for (ForestEvent& event : inputs_.take(stamp)) {
    event.header.frame_id = options_.frame_id;
    apply(event);
    if (!options_.replay) events_publisher_.publish(event);
  }
  forest_->advance(stamp);
  last_tick_ = tick;
  ++counts_.ticks;
  const auto period = static_cast<std::int64_t>(options_.key_frame_period * grid_.rate());
  const bool key_frame = force_key_frame_ || tick % std::max<std::int64_t>(1, period) == 0;
  ForestState message = toMsg(forest_->update(key_frame));
  message.header.frame_id = options_.frame_id;
  counts_.state_bytes += ros::serialization::serializationLength(message);
  state_publisher_.publish(message);
  force_key_frame_ = false;
}

void ForestAnimator::apply(const ForestEvent& event) {
  switch (event.kind) {
    case ForestEvent::VIEWER: {
      forest::Viewer viewer = fromMsg(event.viewer);
      viewer.stamp = fromMsg(event.header.stamp);
      forest_->setViewer(viewer);
      break;
    }
    case ForestEvent::WIND:
      if (const auto wind = inputs_.windOf(event))
        forest_->setWind(*wind);
      else
        reject("event", "asks for a wind that was not heard");
      break;
    case ForestEvent::SETTINGS:
      adoptTuning(tuningOf(event));
      break;
    case ForestEvent::RESET:
      forest_->reset();
      force_key_frame_ = true;
      break;
    default:
      reject("event", "kind = " + std::to_string(event.kind) + " is outside 0 to 3");
  }
}

void ForestAnimator::adoptTuning(const ForestTuning& tuning) {
  tuning_ = tuning;
  forest_->setSettings(tuning.settings);
  forest::Layout layout = designed(scene_.layout, tuning);
  layout.terrain_hash = scene_.terrain->hash();
  if (layout.hash() == forest_->layoutHash()) return;
  forest_->setLayout(std::move(layout), scene_.terrain);
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
