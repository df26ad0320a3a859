// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_field.h"

#include <geometry_msgs/WrenchStamped.h>

#include <algorithm>

#include "core/config/field_values.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {

GrassField::GrassField(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      options_(loadGrassOptions(private_handle, scene_)),
      tuning_(options_.tuning),
      inputs_(options_.replay),
      markers_(options_.marker_points),
      key_frames_(options_.key_frame_period, options_.state_rate, options_.state_bytes),
      tf_listener_(tf_buffer_),
      clock_("grass_field", options_.state_rate, options_.replay ? options_.replay_delay : 0.0,
             {[this] { lookFromFrame(); }, [this](std::int64_t tick) { this->tick(tick); },
              [this](Nanoseconds now) { restart(now); }}),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  grass::Layout& layout = scene_.grass.layout;
  meadow_ =
      std::make_unique<grass::MeadowLod>(layout.map, scene_.terrain, layout.seed, tuning_.view);
  tread_ = std::make_unique<grass::TreadMap>(layout.map->law(), scene_.grass.treading);
  layout.tread_spacing = tread_->spacing();
  field_ = std::make_unique<grass::TreadSimulation>(layout, scene_.terrain, scene_.grass.treading,
                                                    *tread_);
  field_->setDrag(tuning_.drag);
  sources_ =
      std::make_unique<GrassSources>(handle_, options_.frame_id, options_.sources, tf_buffer_);
  layout_publisher_ = handle_.advertise<GrassLayout>("grass/layout", 1, true);
  // A listener gets a key frame at the next tick.
  state_publisher_ = handle_.advertise<GrassState>(
      "grass/state", 1000, [this](const ros::SingleSubscriberPublisher&) { key_frames_.demand(); });
  markers_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("grass/markers", 1);
  events_publisher_ = handle_.advertise<GrassEvent>("grass/events", 10000);
  wrenches_publisher_ = handle_.advertise<geometry_msgs::WrenchStamped>("grass/wrenches", 1000);
  cover_publisher_ = handle_.advertise<nav_msgs::OccupancyGrid>("grass/cover", 1);
  for (std::size_t i = 0; i < COVER_LAYERS.size(); ++i)
    layer_publishers_[i] = handle_.advertise<nav_msgs::OccupancyGrid>(
        std::string("grass/cover/") + COVER_LAYERS[i], 1);
  publishLayout();
  diagnostics_.setHardwareID("none");
  diagnostics_.add("grass", this, &GrassField::diagnose);
  diagnostics_.add("governor", this, &GrassField::diagnoseGovernor);
  tuning_server_ = std::make_unique<dynamic_reconfigure::Server<GrassFieldConfig>>(private_handle_);
  tuning_server_->setCallback(
      [this](GrassFieldConfig& config, std::uint32_t) { onTuning(config); });
  listen();
}

// Last of all: the first callbacks of a nodelet may come while it is still being built.
void GrassField::listen() {
  constexpr unsigned MANY = 2 * EventQueue<GrassEvent>::MOST_WAITING;
  subscribers_ = {handle_.subscribe("wind", 10, &GrassField::onWind, this),
                  handle_.subscribe("viewer", 10, &GrassField::onViewer, this)};
  subscribers_.push_back(options_.replay
                             ? handle_.subscribe("grass/events", MANY, &GrassField::onEvent, this)
                             : handle_.subscribe("tread", MANY, &GrassField::onTread, this));
  services_ = {private_handle_.advertiseService("tread", &GrassField::onTreadPath, this),
               private_handle_.advertiseService("sample", &GrassField::onSample, this),
               private_handle_.advertiseService("clear", &GrassField::onClear, this),
               private_handle_.advertiseService("reset", &GrassField::onReset, this)};
  timers_ = {
      handle_.createTimer(ros::Duration(1.0 / options_.markers_rate), &GrassField::sendMarkers,
                          this),
      handle_.createTimer(ros::Duration(1.0 / options_.cover_rate), &GrassField::sendCover, this)};
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  clock_.listen(handle_);
}

void GrassField::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!options_.replay) followSources(stamp);
  for (GrassEvent& event : inputs_.take(stamp)) {
    event.header.frame_id = options_.frame_id;
    try {
      apply(event);
      ++counts_.events;
      if (!options_.replay) events_publisher_.publish(event);
    } catch (const InvalidInput& error) {
      refusals_.add("event", error.what());
    }
  }
  warnOfLosses("grass_field", inputs_.losses(), published_);
  publishEntering(stamp);
  publishState(tick);
  publishWrenches(stamp);
}

void GrassField::apply(const GrassEvent& event) {
  const Nanoseconds stamp = fromMsg(event.header.stamp);
  switch (event.kind) {
    case GrassEvent::TREAD: {
      const std::string problem =
          field_->apply(fromMsg(event.tread, tuning_.tread, tuning_.height_gate), stamp);
      if (!problem.empty()) refusals_.add("tread", problem);
      break;
    }
    case GrassEvent::CLEAR:
      field_->raise({event.centre.x, event.centre.y}, event.radius);
      key_frames_.demand();
      break;
    case GrassEvent::SETTINGS:
      adoptTuning(fromNamedValues<GrassTuning>({event.names, event.values}));
      break;
    case GrassEvent::RESET:
      startAnew();
      break;
    case GrassEvent::ENTER:  // what the recorded node made of it
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 4");
  }
}

void GrassField::adoptTuning(GrassTuning tuning) {
  check(tuning);
  tuning.view.most_blades = options_.tuning.view.most_blades;
  field_->setDrag(tuning.drag);
  meadow_->setSettings(tuning.view);
  tuning_ = tuning;
  const std::uint64_t before = field_->layout().hash();
  field_->setTreadLaw(tuning.tread);
  if (field_->layout().hash() == before) return;
  key_frames_.demand();
  publishLayout();
}

// What a fresh start now would be, with the layout, wind and settings that are in force.
void GrassField::startAnew() {
  field_->reset();
  sources_->clear();
  key_frames_.demand();
}

void GrassField::restart(Nanoseconds now) {
  startAnew();
  inputs_.forget([&](const GrassEvent& event) {
    return options_.replay ? fromMsg(event.header.stamp) > now
                           : event.kind == GrassEvent::TREAD || event.kind == GrassEvent::CLEAR;
  });
  viewers_.clear();
  tf_buffer_.clear();
  publishLayout();
}

void GrassField::publishLayout() {
  GrassLayout message = toMsg(field_->layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
}

}  // namespace vegetation_sim
