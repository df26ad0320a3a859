// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_animator.h"

#include "core/config/field_values.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

CanopyAnimator::CanopyAnimator(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      options_(loadCanopyOptions(private_handle, scene_)),
      inputs_(options_.replay),
      canopy_(std::make_unique<canopy::Canopy>(scene_.layout)),
      plants_(scene_.layout.plants),
      markers_(options_.marker_points),
      forest_({options_.frame_id, false,
               [this](const std::string& input, const std::string& why) {
                 refusals_.add(input, why);
               }}),
      tf_listener_(tf_buffer_),
      clock_("canopy_animator", scene_.layout.motion.rate,
             options_.replay ? options_.replay_delay : 0.0,
             {[this] { lookFromFrame(); }, [this](std::int64_t tick) { this->tick(tick); },
              [this](Nanoseconds now) { restart(now); }}),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  markers_.setLayout(scene_.layout);
  layout_publisher_ = handle_.advertise<CanopyLayout>("canopy/layout", 1, true);
  state_publisher_ = handle_.advertise<CanopyState>("canopy/state", 1000);
  markers_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("canopy/markers", 1);
  events_publisher_ = handle_.advertise<CanopyEvent>("canopy/events", 1000);
  publishLayout();
  diagnostics_.setHardwareID("none");
  diagnostics_.add("canopy", this, &CanopyAnimator::diagnose);
  diagnostics_.add("governor", this, &CanopyAnimator::diagnoseGovernor);
  tuning_server_ =
      std::make_unique<dynamic_reconfigure::Server<CanopyAnimatorConfig>>(private_handle_);
  tuning_server_->setCallback(
      [this](CanopyAnimatorConfig& config, std::uint32_t) { onTuning(config); });
  listen();
}

// Last of all: the first callbacks of a nodelet may come while it is still being built.
void CanopyAnimator::listen() {
  constexpr unsigned MANY = 2 * EventQueue<CanopyEvent>::MOST_WAITING;
  subscribers_ = {handle_.subscribe("wind", 10, &CanopyAnimator::onWind, this)};
  subscribers_.push_back(
      options_.replay ? handle_.subscribe("canopy/events", MANY, &CanopyAnimator::onEvent, this)
                      : handle_.subscribe("viewer", 10, &CanopyAnimator::onViewer, this));
  if (!scene_.layout.crowns.empty())
    forest_.subscribe(handle_, {"forest/layout", "", "forest/state"});
  services_ = {private_handle_.advertiseService("sample", &CanopyAnimator::onSample, this),
               private_handle_.advertiseService("reset", &CanopyAnimator::onReset, this)};
  markers_timer_ = handle_.createTimer(ros::Duration(1.0 / options_.markers_rate),
                                       &CanopyAnimator::sendMarkers, this);
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  clock_.listen(handle_);
}

void CanopyAnimator::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!begun_ && !options_.replay) publishBeginning(stamp);
  begun_ = true;
  forgetViewer();
  updateCrowns();
  for (CanopyEvent& event : inputs_.take(stamp)) {
    event.header.frame_id = options_.frame_id;
    try {
      apply(event);
      if (!options_.replay) events_publisher_.publish(event);
    } catch (const InvalidInput& error) {
      refusals_.add("event", error.what());
    }
  }
  warnOfLosses("canopy_animator", inputs_.losses(), published_);
  canopy_->advance(stamp);
  publishState(tick);
}

void CanopyAnimator::apply(const CanopyEvent& event) {
  switch (event.kind) {
    case CanopyEvent::VIEWER:
      canopy_->setViewer(event.gone ? std::nullopt
                                    : std::optional<canopy::CutView>(eyeFromMsg(event.eye)));
      break;
    case CanopyEvent::WIND:
      canopy_->setWind(windOf(event.wind_hash));
      break;
    case CanopyEvent::SETTINGS: {
      const auto tuning = fromNamedValues<CanopyTuning>({event.names, event.values});
      canopy_->setMotion(withTuning(canopy_->layout().motion, tuning));
      publishLayout();
      break;
    }
    case CanopyEvent::RESET:
      canopy_->reset();
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 3");
  }
}

wind::Field CanopyAnimator::windOf(std::uint64_t hash) const {
  for (const wind::Field& wind : winds_)
    if (wind.hash() == hash) return wind;
  if (wind::Field calm; calm.hash() == hash) return calm;  // before the first was heard
  throw InvalidInput("wind_hash = " + std::to_string(hash) + " is of no wind that was heard");
}

// What a fresh start now would be, with the layout, wind and settings that are in force.
void CanopyAnimator::restart(Nanoseconds now) {
  canopy_->reset();
  canopy_->setViewer(std::nullopt);
  viewer_.reset();
  inputs_.forget([&](const CanopyEvent& event) {
    return options_.replay ? fromMsg(event.header.stamp) > now : event.kind == CanopyEvent::VIEWER;
  });
  tf_buffer_.clear();
  begun_ = false;
  publishLayout();
}

void CanopyAnimator::publishLayout() {
  CanopyLayout message = toMsg(canopy_->layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
}

}  // namespace vegetation_sim
