// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_broadcaster.h"

#include "nodes/markers/wind_markers.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double DIAGNOSTICS_PERIOD = 1.0;  // [s] of wall time
constexpr double FORGET_PERIOD = 1.0;       // [s]
constexpr double MARKER_PERIODS = 3.0;      // that a marker survives

}  // namespace

WindBroadcaster::WindBroadcaster(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : settings_(readWindSettings(private_nh)),
      nh_(nh),
      private_nh_(private_nh),
      schedule_(settings_.seed),
      follower_(nh, settings_),
      breeze_(settings_.breeze),
      field_publisher_(nh.advertise<WindField>("wind", 1, true)),
      marker_publisher_(nh.advertise<visualization_msgs::MarkerArray>("wind/markers", 1)),
      diagnostics_(nh, private_nh, private_nh.getNamespace()),
      reconfigure_(mutex_, private_nh),
      clock_(nh, [this](Nanoseconds now) { begin(now); }) {
  const Lock lock(mutex_);
  services_ = {
      private_nh.advertiseService("set_primitive", &WindBroadcaster::setPrimitive, this),
      private_nh.advertiseService("remove_primitive", &WindBroadcaster::removePrimitive, this),
      private_nh.advertiseService("get_field", &WindBroadcaster::getField, this),
      private_nh.advertiseService("sample", &WindBroadcaster::sample, this),
      private_nh.advertiseService("reset", &WindBroadcaster::reset, this)};
  follow_timer_ = nh.createTimer(ros::Duration(1.0 / settings_.attach_rate),
                                 [this](const ros::TimerEvent&) { follow(); });
  forget_timer_ =
      nh.createTimer(ros::Duration(FORGET_PERIOD), [this](const ros::TimerEvent&) { forget(); });
  marker_timer_ = nh.createTimer(ros::Duration(1.0 / settings_.markers_rate),
                                 [this](const ros::TimerEvent&) { publishMarkers(); });
  diagnostics_timer_ =
      nh.createWallTimer(ros::WallDuration(DIAGNOSTICS_PERIOD),
                         [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  diagnostics_.setHardwareID("none");
  diagnostics_.add("wind law", this, &WindBroadcaster::diagnose);
  reconfigure_.setCallback(
      [this](WindBroadcasterConfig& config, std::uint32_t level) { reconfigure(config, level); });
}

void WindBroadcaster::begin(Nanoseconds now) {
  const Lock lock(mutex_);
  schedule_ = initialSchedule(settings_, now);
  follower_.clear();
  for (const wind::Source& source : settings_.sources)
    if (!source.attached_frame.empty()) follower_.set(wind::startedAt(source, now));
  publishField();
  showBreeze(settings_.breeze);
}

Nanoseconds WindBroadcaster::earliest() const {
  return clock_.now() + fromSeconds(settings_.lead);
}

std::optional<wind::Primitive> WindBroadcaster::apply(const wind::Source& source, Faults faults) {
  wind::checkFrame(source, faults);
  wind::PrimitiveSchedule edited = schedule_;
  wind::Primitive filled;  // with the times that the request left open
  try {
    filled = edited.set(source.primitive, earliest());
  } catch (const InvalidInput& error) {
    faults.add(error.what());
  }
  faults.throwIfAny();
  if (!source.attached_frame.empty()) {
    follower_.set({filled, source.attached_frame});
    return std::nullopt;
  }
  follower_.remove(filled.name);
  schedule_ = std::move(edited);
  publishField();
  return filled;
}

void WindBroadcaster::remove(const std::string& name) {
  const bool blows = schedule_.find(name, earliest()).has_value();
  if (blows || !follower_.follows(name)) schedule_.remove(name, earliest());
  follower_.remove(name);
}

void WindBroadcaster::follow() {
  const Lock lock(mutex_);
  if (!clock_.running()) return;
  try {
    if (follower_.update(schedule_, clock_.now())) publishField();
  } catch (const InvalidInput& error) {
    refuse("followed frame", error.what());
  }
}

void WindBroadcaster::forget() {
  const Lock lock(mutex_);
  if (clock_.running() && schedule_.prune(clock_.now())) publishField();
}

void WindBroadcaster::publishField() {
  field_publisher_.publish(toMsg(schedule_.field(), settings_.frame_id, clock_.now()));
}

void WindBroadcaster::publishMarkers() {
  const Lock lock(mutex_);
  if (!clock_.running() || marker_publisher_.getNumSubscribers() == 0) return;
  marker_publisher_.publish(windMarkers(schedule_.field(), settings_.frame_id, clock_.now(),
                                        MARKER_PERIODS / settings_.markers_rate));
}

void WindBroadcaster::showBreeze(const BreezeSettings& breeze) {
  breeze_ = breeze;
  reconfigure_.updateConfig(toConfig(breeze_));
}

void WindBroadcaster::noteBreeze() {
  BreezeSettings now = breeze_;
  now.speed = 0.0;
  if (const auto found = schedule_.find(BreezeSettings::NAME, earliest()))
    now = BreezeSettings::of(*found, breeze_.direction);
  if (now != breeze_) showBreeze(now);
}

void WindBroadcaster::refuse(const std::string& what, const std::string& why) {
  ++refused_;
  last_refusal_ = what + ": " + why;
  ROS_WARN_STREAM_THROTTLE(1.0, "refused " << last_refusal_);
}

void WindBroadcaster::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const Lock lock(mutex_);
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "blowing");
  if (!clock_.running()) status.summary(DiagnosticStatus::WARN, "waiting for time to begin");
  std::string missing;
  for (const std::string& frame : follower_.missing())
    missing += (missing.empty() ? "" : ", ") + frame;
  if (!missing.empty()) status.mergeSummary(DiagnosticStatus::WARN, "no tf of late for " + missing);
  status.add("primitives", schedule_.field().primitives().size());
  status.add("sources", schedule_.names(clock_.now()).size());
  status.add("followed frames", follower_.names().size());
  status.add("missing frames", missing);
  status.add("hash", schedule_.field().hash());
  status.add("refused inputs", refused_);
  status.add("last refusal", last_refusal_);
  status.add("jumps back in time", clock_.jumps());
}

}  // namespace vegetation_sim
