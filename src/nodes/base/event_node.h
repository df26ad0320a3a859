// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <tf2_ros/buffer.h>
#include <vegetation_sim/PredictedErrors.h>
#include <vegetation_sim/Viewer.h>

#include <boost/thread/recursive_mutex.hpp>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config/field_values.h"
#include "nodes/base/saved_node.h"
#include "nodes/listeners/viewer_registry.h"
#include "nodes/markers/marker_publisher.h"
#include "nodes/shard_requests/shard_check.h"
#include "ros/conversions/recorded_message.h"
#include "ros/services/frame_listener.h"
#include "ros/services/request_checks.h"
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
/// published ones instead. The base has what such nodes share: clock, queue, snapshots, tf, tuning
/// by dynamic_reconfigure, viewers and the one that follows a tf frame, markers, service ~reset and
/// diagnostics.
///
/// A node calls start() at the end of its constructor and stop() in its destructor.
/// @tparam Queue EventQueue or derived from it. @tparam Config of dynamic_reconfigure.
/// @tparam Options derived from NodeOptions.
template <class Queue, class Config, class Options>
class EventNode : public SavedNode<Queue, Options> {
 protected:
  using Base = SavedNode<Queue, Options>;
  using Base::acceptInput;
  using Base::clock_;
  using Base::diagnostics_;
  using Base::enqueue;
  using Base::handle_;
  using Base::inputs_;
  using Base::lastStamp;
  using Base::name_;
  using Base::options_;
  using Base::private_handle_;
  using Base::refusals_;
  using Base::refused_requests_;
  using Base::refuseInReplay;
  using typename Base::Event;
  using typename Base::Message;

  /// @param topic of the events.
  EventNode(const char* name, const char* topic, const ros::NodeHandle& handle,
            const ros::NodeHandle& private_handle, Options options)
      : Base(name, topic, handle, private_handle, std::move(options),
             {[this] { acceptInput("viewer", [this] { followViewerFrame(); }); },
              [this](std::int64_t tick) { acceptInput("tick", [&] { onTick(tick); }); },
              [this](Nanoseconds now) { acceptInput("clock", [&] { onJumpBack(now); }); },
              [this] { sendOutputs(); }}),
        tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                   true),  // with the service that shows its frames
        tf_listener_(tf_buffer_),
        events_topic_(topic) {}

  /// Adds the node's subscribers, services and timers.
  virtual void connect() = 0;
  /// Becomes what a fresh start would be, after the clock has jumped back to `now`.
  virtual void restart(Nanoseconds now) = 0;
  /// Whether a live event that waits is void once the clock has jumped back to `now`.
  virtual bool isOutdated(const Event& event, Nanoseconds now) const = 0;
  /// Whether a replay applies this recorded event.
  virtual bool isInput(const Event&) const { return true; }
  /// Takes a viewer of the markers. A node whose state depends on viewers makes events of them.
  virtual void onViewer(const Viewer& message) {
    acceptInput("viewer",
                [&] { viewers_.hear(message, tf_buffer_, options_.frame_id, lastStamp()); });
  }
  bool areMarkersWanted() const { return markers_->isWanted(); }
  /// Viewers of the markers at the last tick.
  virtual std::vector<Viewpoint> markerViewers(Nanoseconds stamp) { return viewers_.eyesAt(stamp); }
  /// Writes the tuning in force into what dynamic_reconfigure shows first.
  virtual void showTuning(Config& config) const = 0;
  /// Event of a new tuning. @throws InvalidInput for values out of range.
  virtual Event tuningEvent(const Config& config) const = 0;
  virtual void addDiagnostics(NodeBase::Status& status) = 0;
  /// Reports what the node chooses within its budgets, and why.
  virtual void addGovernor(NodeBase::Status& status) = 0;
  /// Predicts the errors of what the node sends (N9).
  virtual std::vector<PredictedError> predictErrors() const = 0;

  /// Whether the node has a part of the world, and others have the rest.
  bool isPart() const { return options_.shard && options_.shard->count > 1; }
  /// Whether the node shows the world of all shards, which shard 0 does for all.
  bool showsAll() const { return !options_.shard || options_.shard->index == 0; }
  /// Joins the other shards, if there are any; to be called before the node publishes. A node that
  /// has the whole refuses them.
  /// @param what the node simulates. @param messages md5 sums of layout and state.
  /// @throws InvalidInput if a shard that was there before does not fit.
  void join(const char* what, const std::string& messages, std::uint64_t layout_hash,
            std::uint64_t terrain_hash) {
    const std::string shards = std::string(what) + "/shards";
    if (!isPart() && !options_.replay) this->refuseShards(shards);
    if (!isPart()) return;
    ShardNode own;
    own.header.frame_id = options_.frame_id;
    own.shard = options_.shard->index;
    own.shards = options_.shard->count;
    own.messages = messages;
    own.layout_hash = layout_hash;
    own.terrain_hash = terrain_hash;
    own.rate = static_cast<std::uint32_t>(options_.state_rate);
    this->joinShards(shards, std::move(own), options_.shard_wait);
  }
  /// @param what the node simulates, in diagnostics. @param topic of the markers.
  void start(const char* what, const char* topic, MarkerBuilder& markers) {
    markers_.emplace(handle_, topic, options_.frame_id, markers);
    const std::string layer = std::string(topic).substr(0, std::string(topic).rfind('/'));
    errors_publisher_ = handle_.template advertise<PredictedErrors>(layer + "/errors", 10);
    diagnostics_.add(what, this, &EventNode::diagnose);
    diagnostics_.add("governor", this, &EventNode::diagnoseGovernor);
    this->recover();
    // The server writes its values back to the parameters: they are the checked ones by then.
    tuning_server_ = std::make_unique<dynamic_reconfigure::Server<Config>>(mutex_, private_handle_);
    tuning_server_->setCallback([this](Config& config, std::uint32_t) { onTuning(config); });
    connect();
    this->subscribe("viewer", 10, &EventNode::onViewer);
    repeat(options_.markers_rate, &EventNode::sendMarkers);
    if (options_.replay) subscribeToRecorded();
    this->serveShared("reset", &EventNode::onReset, toAllShards<std_srvs::Trigger::Request>(),
                      Repeat::ALLOWED, joinReplies<std_srvs::Trigger::Response>);
    this->serveSnapshots();
    this->startDiagnostics();
    if (clock_.hasBegun()) this->openServices();  // after a checkpoint
    clock_.listen(handle_);
  }
  void stop() {
    this->stopCallbacks();
    clock_.stop();
    recorded_.shutdown();
    tuning_server_.reset();
  }

  /// Calls a function after the ticks with which its periods begin; once for several ticks that
  /// are late. A timer of ROS time would wake each node a thousand times a second.
  template <class Node>
  void repeat(double rate, void (Node::*callback)()) {
    outputs_.push_back({rate, [this, callback] { (static_cast<Node*>(this)->*callback)(); }});
  }
  /// The route of requests that concern all shards.
  template <class Request>
  typename Base::template ShardRoute<Request> toAllShards() const {
    std::vector<std::uint32_t> all(options_.shard ? options_.shard->count : 1);
    std::iota(all.begin(), all.end(), 0U);
    return [all](Request&) { return all; };
  }

  /// Pose of a frame in the world frame. @throws InvalidInput if tf has no transform.
  Pose poseOf(const std::string& frame, const ros::Time& stamp = ros::Time(0)) const {
    return poseInWorld(tf_buffer_, options_.frame_id, frame, stamp);
  }

  // Reports a summary, warnings since the last report and the values that all such nodes have.
  void diagnose(NodeBase::Status& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(DiagnosticStatus::OK, "running");
    if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
    this->warnOfRefusals(status);
    if (is_other_version_ && recorded_.getNumPublishers() == 0) subscribeToRecorded();
    this->warnOfRivals(status);
    this->warnOfInterruptions(status);
    this->addShards(status);
    warnOfClock(status, clock_.counts(), reported_clock_);
    warnOfLosses(status, inputs_.losses(), reported_losses_);
    reported_clock_ = clock_.counts();
    reported_losses_ = inputs_.losses();
    addDiagnostics(status);
    clock_.report(status);
    status.add("Inputs taken", this->applied_);
    this->addRefusals(status);
    status.add("Inputs lost", inputs_.losses().lost);
    status.add("Recorded events late", inputs_.losses().late);
  }

  tf2_ros::Buffer tf_buffer_;
  ViewerRegistry viewers_;  // of the markers

 private:
  FrameListener tf_listener_;

  struct Output {
    double rate;  // [Hz]
    std::function<void()> send;
    bool is_due{false};
    std::int64_t period{-1};  // of the last tick
  };

  void onTick(std::int64_t tick) {
    for (Output& output : outputs_) {
      const std::int64_t period = periodOf(tick, output.rate, clock_.grid().rate());
      output.is_due |= std::exchange(output.period, period) != period;
    }
    this->runTick(tick);
    this->openServices();
  }

  void sendOutputs() {
    for (Output& output : outputs_)
      if (std::exchange(output.is_due, false)) acceptInput("output", output.send);
  }

  // A subscriber of any type takes the type of its first publisher for good. After the player of
  // another version has ended it is made anew.
  void subscribeToRecorded() {
    const boost::function<void(const topic_tools::ShapeShifter&)> guarded =
        [this](const topic_tools::ShapeShifter& recorded) {
          acceptInput(events_topic_, [&] { onRecordedEvent(recorded); });
        };
    is_other_version_ = false;
    recorded_.shutdown();
    recorded_ = handle_.template subscribe<topic_tools::ShapeShifter>(
        events_topic_, 2 * Queue::MOST_WAITING, guarded);
  }

  void onRecordedEvent(const topic_tools::ShapeShifter& recorded) {
    is_other_version_ = true;
    const auto message = readRecorded<Message>(recorded);
    is_other_version_ = false;
    acceptInput("event", [&] {
      const Event& event = eventFromMsg(*message);
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

  void onLoaded() override {
    if (!tuning_server_) return;
    showTuning(*shown_);
    tuning_server_->updateConfig(*shown_);
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

  void sendMarkers() {
    if (!markers_->isWanted()) return;
    markers_->publish(markerViewers(clock_.stamp()), clock_.stamp());
  }

  void diagnoseGovernor(NodeBase::Status& status) {
    addGovernor(status);
    markers_->report(status);
    if (errors_publisher_.getNumSubscribers() == 0) return;
    PredictedErrors message;
    message.header.stamp = toStamp(lastStamp());
    message.header.frame_id = options_.frame_id;
    message.errors = predictErrors();
    errors_publisher_.publish(message);
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
      return options_.replay ? stampOf(event) > now : isOutdated(event, now);
    });
    this->forgetCheckpoint();
    tf_buffer_.clear();
    viewers_.clear();
    restart(now);
  }

  const char* events_topic_;
  ros::Subscriber recorded_;      // to events of any version, in a replay
  bool is_other_version_{false};  // of the last recorded event
  std::optional<MarkerPublisher> markers_;
  std::vector<Output> outputs_;
  ros::Publisher errors_publisher_;
  boost::recursive_mutex mutex_;  // of the server, whose values a load changes
  std::unique_ptr<dynamic_reconfigure::Server<Config>> tuning_server_;
  std::optional<Config> shown_;  // what the server shows or has accepted last
  TickClock::Counts reported_clock_;
  QueueLosses reported_losses_;  // on /diagnostics
};

}  // namespace vegetation_sim
