// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_broadcaster.h"

#include <utility>

#include "nodes/base/freed_memory.h"
#include "nodes/base/node_factory.h"
#include "nodes/markers/wind_markers.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double PRUNE_RATE = 1.0;      // [Hz]
constexpr double MARKER_PERIODS = 3.0;  // that a marker survives

}  // namespace

WindBroadcaster::WindBroadcaster(const ros::NodeHandle& handle,
                                 const ros::NodeHandle& private_handle)
    : NodeBase("wind_broadcaster", handle, private_handle),
      settings_(readWindSettings(private_handle)),
      schedule_(settings_.seed),
      tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                 true),  // with the service that shows its frames
      tf_listener_(tf_buffer_, handle_),
      follower_(tf_buffer_, settings_),
      probes_(tf_buffer_, settings_.frame_id, settings_.sample_frames),
      breeze_(settings_.breeze),
      field_publisher_(handle_.advertise<WindField>("wind", 1, true)),
      marker_publisher_(handle_.advertise<visualization_msgs::MarkerArray>("wind/markers", 1)),
      samples_publisher_(handle_.advertise<WindSamples>("wind/samples", 10)),
      snapshots_(settings_.snapshots, name_, private_handle_.getNamespace(), snapshotCalls()),
      reconfigure_(mutex_, private_handle_),
      clock_(handle_, [this](Nanoseconds now) { acceptInput("clock", [&] { begin(now); }); }) {
  diagnostics_.add("wind law", this, &WindBroadcaster::diagnose);  // takes the mutex in a report
  const Lock lock(mutex_);
  serve("set_primitive", &WindBroadcaster::setPrimitive);
  serve("remove_primitive", &WindBroadcaster::removePrimitive);
  serve("get_field", &WindBroadcaster::getField);
  serve("sample", &WindBroadcaster::sample);
  serve("reset", &WindBroadcaster::reset);
  serve("save_snapshot", &WindBroadcaster::saveSnapshot);
  serve("load_snapshot", &WindBroadcaster::loadSnapshot);
  repeat(settings_.attach_rate, &WindBroadcaster::follow);
  repeat(PRUNE_RATE, &WindBroadcaster::prune);
  repeat(settings_.markers_rate, &WindBroadcaster::publishMarkers);
  repeat(settings_.sample_rate, &WindBroadcaster::publishSamples);
  startDiagnostics();
  reconfigure_.setCallback(
      [this](WindBroadcasterConfig& config, std::uint32_t level) { reconfigure(config, level); });
}

void WindBroadcaster::begin(Nanoseconds now) {
  const Lock lock(mutex_);
  if (begun_ || !resume(now)) beginScenario(now);
  begun_ = true;
  openServices();
}

void WindBroadcaster::beginScenario(Nanoseconds now) {
  schedule_ = initialSchedule(settings_, now);
  tf_buffer_.clear();
  follower_.clear();
  for (const wind::Source& source : settings_.sources)
    if (!source.attached_frame.empty()) follower_.set(wind::startedAt(source, now));
  breeze_ = settings_.breeze;
  publishField();
  showBreeze();
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
  return filled;
}

void WindBroadcaster::remove(const std::string& name) {
  const bool blows = schedule_.find(name, earliest()).has_value();
  if (blows || !follower_.follows(name)) schedule_.remove(name, earliest());
  follower_.remove(name);
}

void WindBroadcaster::follow(const ros::TimerEvent&) {
  const Lock lock(mutex_);
  if (!clock_.running()) return;
  acceptInput("followed frame", [&] {
    const auto report = [this](const std::string& what, const std::string& why) {
      refusals_.add(what, why);
    };
    if (follower_.update(schedule_, clock_.now(), report)) publishField();
  });
}

void WindBroadcaster::prune(const ros::TimerEvent&) {
  const Lock lock(mutex_);
  if (clock_.running() && schedule_.prune(clock_.now())) publishField();
}

void WindBroadcaster::checkpoint() {
  acceptInput("checkpoint", [this] { snapshots_.checkpoint(); });
}

// A wind that others know survives a kill, so the checkpoint comes first.
void WindBroadcaster::publishField() {
  checkpoint();
  field_publisher_.publish(toMsg(schedule_.field(), settings_.frame_id, clock_.now()));
}

void WindBroadcaster::publishEdit() {
  const bool is_other_breeze = updateBreeze();
  publishField();
  if (is_other_breeze) showBreeze();
}

void WindBroadcaster::publishMarkers(const ros::TimerEvent&) {
  const Lock lock(mutex_);
  if (!clock_.running() || marker_publisher_.getNumSubscribers() == 0) return;
  marker_publisher_.publish(windMarkers(schedule_.field(), settings_.frame_id, clock_.now(),
                                        MARKER_PERIODS / settings_.markers_rate));
}

void WindBroadcaster::publishSamples(const ros::TimerEvent&) {
  const Lock lock(mutex_);
  if (!clock_.running() || probes_.empty()) return;
  samples_publisher_.publish(probes_.sample(schedule_.field(), clock_.now()));
}

void WindBroadcaster::showBreeze() {
  reconfigure_.updateConfig(toConfig(breeze_));
}

bool WindBroadcaster::updateBreeze() {
  BreezeSettings now = breeze_;
  now.speed = 0.0;
  if (const auto found = schedule_.find(BreezeSettings::NAME, earliest()))
    now = BreezeSettings::of(*found, breeze_.direction);
  return std::exchange(breeze_, now) != now;
}

void WindBroadcaster::diagnose(Status& status) {
  const Lock lock(mutex_);
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.running()) status.summary(DiagnosticStatus::WARN, "waiting for time to begin");
  refusals_.warn(status);
  warnOfInterruptions(status);
  for (MissingInputs* missing : {&follower_.missing(), &probes_.missing()})
    missing->warn(name_, status);
  status.add("primitives", schedule_.field().primitives().size());
  status.add("sources", schedule_.names(clock_.now()).size());
  status.add("followed frames", follower_.names().size());
  status.add("missing frames", follower_.missing().size());
  status.add("hash", schedule_.field().hash());
  status.add("refused inputs", refusals_.count());
  status.add("last refusal", refusals_.last());
  status.add("jumps back in time", clock_.jumps());
  status.add("Memory in use [B]", countUsedMemory());
}

std::shared_ptr<void> createWindBroadcaster(const ros::NodeHandle& handle,
                                            const ros::NodeHandle& private_handle) {
  return std::make_shared<WindBroadcaster>(handle, private_handle);
}

}  // namespace vegetation_sim
