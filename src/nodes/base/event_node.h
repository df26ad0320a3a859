// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <vegetation_sim/Viewer.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/config/field_values.h"
#include "nodes/base/event_queue.h"
#include "nodes/base/node_base.h"
#include "nodes/base/node_options.h"
#include "nodes/base/viewer_registry.h"
#include "nodes/markers/marker_publisher.h"
#include "ros/services/requests.h"
#include "ros/services/service_replies.h"
#include "ros/time/tick_clock.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

/// Event of a tuning, with the names and values of all its fields.
template <class Event, class Tuning>
Event settingsEvent(const Tuning& tuning) {
  NamedValues named = namedValues(tuning);
  Event out;
  out.kind = Event::SETTINGS;
  out.names = std::move(named.names);
  out.values = std::move(named.values);
  return out;
}

/// A simulation on the tick grid of ROS time whose state is a function of its events. Inputs wait
/// in a queue as events; at their tick they are applied and published, and a replay applies the
/// published ones instead. The base has what such nodes share: clock, tf, queue, tuning by
/// dynamic_reconfigure, viewers and the one that follows a tf frame, markers, service ~reset and
/// diagnostics.
///
/// A node calls start() at the end of its constructor and stop() in its destructor.
/// @tparam Queue EventQueue or derived from it. @tparam Config of dynamic_reconfigure.
/// @tparam Options derived from NodeOptions.
template <class Queue, class Config, class Options>
class EventNode : public NodeBase {
 protected:
  using Event = typename Queue::Event;
  using Message = typename Queue::Message;

  /// @param topic of the events.
  EventNode(const char* name, const char* topic, const ros::NodeHandle& handle,
            const ros::NodeHandle& private_handle, Options options)
      : NodeBase(name, handle, private_handle),
        options_(std::move(options)),
        inputs_(options_.replay),
        tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                   true),  // with the service that shows its frames
        tf_listener_(tf_buffer_),
        clock_(name_, options_.state_rate, options_.replay ? options_.replay_delay : 0.0,
               {[this] { acceptInput("viewer", [this] { followViewerFrame(); }); },
                [this](std::int64_t tick) { acceptInput("tick", [&] { onTick(tick); }); },
                [this](Nanoseconds now) { acceptInput("clock", [&] { onJumpBack(now); }); }}),
        events_topic_(topic),
        events_publisher_(handle_.advertise<Message>(topic, Queue::MOST_WAITING)) {}

  /// Adds the node's subscribers, services and timers.
  virtual void connect() = 0;
  virtual void tick(std::int64_t tick) = 0;
  /// Applies an event to the simulation. @throws InvalidInput, and then nothing has changed.
  virtual void apply(Event& event) = 0;
  /// Becomes what a fresh start would be, after the clock has jumped back.
  virtual void restart() = 0;
  /// Whether a live event that waits is void once the clock has jumped back.
  virtual bool isOutdated(const Event& event) const = 0;
  /// Whether a replay applies this recorded event.
  virtual bool isInput(const Event&) const { return true; }
  /// Takes a viewer of the markers. A node whose state depends on viewers makes events of them.
  virtual void onViewer(const Viewer& message) {
    acceptInput("viewer",
                [&] { viewers_.hear(message, tf_buffer_, options_.frame_id, lastStamp()); });
  }
  /// Viewers of the markers at the last tick.
  virtual std::vector<Viewpoint> markerViewers(Nanoseconds stamp) { return viewers_.eyesAt(stamp); }
  /// Writes the tuning in force into what dynamic_reconfigure shows first.
  virtual void showTuning(Config& config) const = 0;
  /// Event of a new tuning. @throws InvalidInput for values out of range.
  virtual Event tuningEvent(const Config& config) const = 0;
  virtual void addDiagnostics(NodeBase::Status& status) = 0;
  /// Reports what the node chooses within its budgets, and why.
  virtual void addGovernor(NodeBase::Status& status) = 0;

  /// @param what the node simulates, in diagnostics. @param topic of the markers.
  void start(const char* what, const char* topic, MarkerBuilder& markers) {
    markers_.emplace(handle_, topic, options_.frame_id, markers);
    diagnostics_.add(what, this, &EventNode::diagnose);
    diagnostics_.add("governor", this, &EventNode::diagnoseGovernor);
    // The server writes its values back to the parameters: they are the checked ones by then.
    tuning_server_ = std::make_unique<dynamic_reconfigure::Server<Config>>(private_handle_);
    tuning_server_->setCallback([this](Config& config, std::uint32_t) { onTuning(config); });
    connect();
    subscribe("viewer", 10, &EventNode::onViewer);
    repeat(options_.markers_rate, &EventNode::sendMarkers);
    if (options_.replay)
      subscribe(events_topic_, 2 * Queue::MOST_WAITING, &EventNode::onRecordedEvent);
    serve("reset", &EventNode::onReset);
    startDiagnostics();
    clock_.listen(handle_);
  }
  void stop() {
    clock_.stop();
    stopCallbacks();
    tuning_server_.reset();
  }

  void refuseInReplay() const {
    if (options_.replay) throw InvalidInput("a replay follows its recorded events only");
  }
  /// @throws InvalidInput if the queue is full.
  void enqueue(Event event) {
    if (!inputs_.add(std::move(event))) throw InvalidInput(Queue::describeFull());
  }
  /// Applies the events of a tick in order, and publishes them unless this is a replay.
  void applyInputs(Nanoseconds stamp) {
    for (Event& event : inputs_.take(stamp)) {
      acceptInput("event", [&] {
        apply(event);
        ++applied_;
        publishEvent(event);
      });
    }
    warnOfLosses(name_.c_str(), inputs_.losses(), warned_);
  }
  void publishEvent(const Event& event) {
    if (options_.replay) return;
    Message message = eventToMsg(event);
    message.header.frame_id = options_.frame_id;
    events_publisher_.publish(message);
  }
  /// Pose of a frame in the world frame. @throws InvalidInput if tf has no transform.
  Pose poseOf(const std::string& frame, const ros::Time& stamp = ros::Time(0)) const {
    return poseInWorld(tf_buffer_, options_.frame_id, frame, stamp);
  }
  /// Stamp of the last tick, 0 before the first.
  Nanoseconds lastStamp() const { return clock_.hasBegun() ? clock_.stamp() : 0; }

  // Reports a summary, warnings since the last report and the values that all such nodes have.
  void diagnose(NodeBase::Status& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(DiagnosticStatus::OK, "running");
    if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
    refusals_.warn(status);
    warnOfRivals(status);
    warnOfClock(status, clock_.counts(), reported_clock_);
    warnOfLosses(status, inputs_.losses(), reported_losses_);
    reported_clock_ = clock_.counts();
    reported_losses_ = inputs_.losses();
    addDiagnostics(status);
    clock_.report(status);
    status.add("Inputs taken", applied_);
    status.add("Inputs refused", refusals_.count());
    status.add("Inputs lost", inputs_.losses().lost);
    status.add("Recorded events late", inputs_.losses().late);
  }

  Options options_;
  Queue inputs_;
  tf2_ros::Buffer tf_buffer_;
  ViewerRegistry viewers_;  // of the markers

 private:
  tf2_ros::TransformListener tf_listener_;

 protected:
  TickClock clock_;

 private:
  void onTick(std::int64_t tick) {
    this->tick(tick);
    openServices();
  }

  void onRecordedEvent(const Message& message) {
    acceptInput("event", [&] {
      const Event& event = eventFromMsg(message);
      if (isInput(event)) inputs_.addRecorded(event);
    });
  }

  void onTuning(Config& config) {
    if (!shown_) {
      showTuning(config);  // some values may come from the scenario
      shown_ = config;
      return;
    }
    try {
      refuseInReplay();
      enqueue(tuningEvent(config));
      shown_ = config;
    } catch (const std::exception& error) {
      refusals_.add("settings", error.what());
      config = *shown_;
    }
  }

  bool onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    return answer(response, [&]() -> std::string {
      refuseInReplay();
      Event event;
      event.kind = Event::RESET;
      enqueue(std::move(event));
      return "takes effect at the next tick";
    });
  }

  void sendMarkers(const ros::TimerEvent&) {
    if (!clock_.hasBegun() || !markers_->isWanted()) return;
    markers_->publish(markerViewers(clock_.stamp()), clock_.stamp());
  }

  void diagnoseGovernor(NodeBase::Status& status) {
    addGovernor(status);
    markers_->report(status);
  }

  void followViewerFrame() {
    if (options_.viewer_frame.empty()) return;
    Viewer viewer;
    viewer.id = options_.viewer_id.empty() ? "tf:" + options_.viewer_frame : options_.viewer_id;
    viewer.header.frame_id = options_.viewer_frame;
    viewer.pose.orientation.w = 1.0;
    viewer.field_of_view = options_.viewer_field_of_view;
    viewer.height = static_cast<std::uint32_t>(options_.viewer_height);
    onViewer(viewer);
  }

  void onJumpBack(Nanoseconds now) {
    inputs_.forget([&](const Event& event) {
      return options_.replay ? stampOf(event) > now : isOutdated(event);
    });
    tf_buffer_.clear();
    viewers_.clear();
    restart();
  }

  const char* events_topic_;
  ros::Publisher events_publisher_;
  std::optional<MarkerPublisher> markers_;
  std::unique_ptr<dynamic_reconfigure::Server<Config>> tuning_server_;
  std::optional<Config> shown_;  // what the server shows or has accepted last
  std::uint64_t applied_{0};     // events
  TickClock::Counts reported_clock_;
  QueueLosses reported_losses_, warned_;  // on /diagnostics, on the console
};

}  // namespace vegetation_sim
