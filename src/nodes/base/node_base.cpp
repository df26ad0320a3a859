// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_base.h"

#include <algorithm>

#include "nodes/base/freed_memory.h"
#include "nodes/shard_requests/shard_check.h"
#include "ros/services/rivals.h"

namespace vegetation_sim {
namespace {

constexpr int RELEASE_PERIOD = 10;     // reports between two releases of freed memory
constexpr double BEAT_PERIOD = 0.2;    // [s] of wall time
constexpr double SHORTEST_WAIT = 0.7;  // that is reported [s]
constexpr double LONGEST_LOOK = 0.05;  // for awaited messages [s]

ros::NodeHandle handleOf(ros::NodeHandle handle, ClosableQueue& callbacks) {
  handle.setCallbackQueue(&callbacks);
  return handle;
}

}  // namespace

NodeBase::NodeBase(const std::string& name, const ros::NodeHandle& handle,
                   const ros::NodeHandle& private_handle)
    : name_(name),
      callbacks_(makeClosableQueue(*handle.getCallbackQueue())),
      handle_(handleOf(handle, callbacks_)),
      private_handle_(handleOf(private_handle, callbacks_)),
      refusals_(name),
      refused_requests_(name, "request"),
      diagnostics_(handle_, private_handle_, private_handle.getNamespace()) {
  diagnostics_.setHardwareID("none");
}

bool NodeBase::awaitInputs(double wait, const std::function<bool()>& is_complete) {
  awaited_.callAvailable();
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(wait);
  while (!is_complete()) {
    const ros::WallDuration left = deadline - ros::WallTime::now();
    if (left <= ros::WallDuration(0.0) || is_ending_ || !ros::ok()) return false;
    awaited_.callAvailable(std::min(left, ros::WallDuration(LONGEST_LOOK)));
  }
  return true;
}

void NodeBase::startDiagnostics() {
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this, reports = 0](const ros::WallTimerEvent&) mutable {
        if (++reports % RELEASE_PERIOD == 0) releaseFreedMemory();
        acceptInput("diagnostics", [this] { diagnostics_.force_update(); });
        announceShard();
      });
  // The ticks that the node has missed since its checkpoint may take longer than the first period.
  if (reports_of_start_ > 0) acceptInput("diagnostics", [this] { diagnostics_.force_update(); });
  beat_timer_ = handle_.createWallTimer(ros::WallDuration(BEAT_PERIOD),
                                        [this](const ros::WallTimerEvent&) { beat(); });
}

// The timer shares the queue of all callbacks, so a beat that is late shows how long they waited.
void NodeBase::beat() {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (last_beat_) {
    const double since = std::chrono::duration<double>(now - *last_beat_).count();
    longest_wait_ = std::max(longest_wait_, since - BEAT_PERIOD);
  }
  last_beat_ = now;
}

void NodeBase::warnOfInterruptions(Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (reports_of_start_ > 0) {
    --reports_of_start_;
    status.mergeSummaryf(DiagnosticStatus::WARN, "continues from its checkpoint of %.3f s",
                         secondsBetween(0, continued_from_));
  }
  if (longest_wait_ >= SHORTEST_WAIT)
    status.mergeSummaryf(DiagnosticStatus::WARN,
                         "no callback ran for %.1f s: the process was stopped, or one took so long",
                         longest_wait_);
  longest_wait_ = 0.0;
}

void NodeBase::openServices() {
  const bool opens = !std::exchange(open_, true);
  for (const auto& advertise : closed_) services_.push_back(advertise());
  closed_.clear();
  if (opens) announceShard();
}

void NodeBase::announceShard() {
  if (!shards_) return;
  ShardNode message = shards_->registry().own();
  message.header.stamp = ros::Time::now();
  message.open = open_;
  shard_publisher_.publish(message);
}

void NodeBase::joinShards(const std::string& topic, ShardNode own, double time_limit) {
  own.node = private_handle_.getNamespace();
  const ros::WallTime now = ros::WallTime::now();
  own.started = ros::Time(now.sec, now.nsec);
  shards_ = std::make_unique<ShardRequests>(private_handle_, std::move(own), time_limit);
  shard_publisher_ = handle_.advertise<ShardNode>(topic, 1, true);
  announceShard();
  requireFit(handle_, topic, shards_->registry());
  using Event = ros::MessageEvent<ShardNode const>;
  const boost::function<void(const Event&)> hear = [this, topic](const Event& event) {
    acceptInput(topic, [&] {
      shards_->registry().hear(*event.getMessage(), event.getPublisherName(),
                               std::chrono::steady_clock::now());
    });
  };
  subscribers_.push_back(handle_.subscribe<ShardNode>(topic, MOST_SHARDS, hear));
}

void NodeBase::refuseShards(const std::string& topic) {
  const std::string node = private_handle_.getNamespace();
  requireNoShards(handle_, topic, node);
  const boost::function<void(const ShardNode&)> hear = [this, topic,
                                                        node](const ShardNode& message) {
    acceptInput(topic, [&] { refuseShard(message, node); });
  };
  subscribers_.push_back(handle_.subscribe<ShardNode>(topic, MOST_SHARDS, hear));
}

void NodeBase::addShards(Status& status) {
  if (!shards_) return;
  const std::string missing = shards_->registry().describeMissing();
  if (open_ && !missing.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        "no node animates these of the " + std::to_string(shards_->shard().count) +
                            " shards: " + missing);
  const std::string silent = shards_->registry().describeSilent(std::chrono::steady_clock::now());
  if (!silent.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        "no message for 3 s from these shards: " + silent);
  status.add("Requests passed on to other shards", shards_->sent());
}

void NodeBase::stopCallbacks() {
  is_ending_ = true;
  callbacks_.close();
  if (shards_) shards_->stop();
  diagnostics_timer_.stop();
  beat_timer_.stop();
  timers_.clear();
  services_.clear();
  owned_.clear();
  subscribers_.clear();
}

void NodeBase::warnOfRefusals(Status& status) {
  refusals_.warn(status);
  refused_requests_.warn(status);
}

void NodeBase::addRefusals(Status& status) const {
  status.add("Inputs refused", refusals_.count());
  status.add("Requests refused", refused_requests_.count());
  status.add("Memory in use [B]", countUsedMemory());
}

void NodeBase::countOwners(std::size_t topic, const std::string& shards) {
  const boost::function<void(const ShardNode&)> hear = [this, topic,
                                                        shards](const ShardNode& message) {
    acceptInput(shards, [&] {
      checkShard(message);
      owned_[topic].announced = message.shards;
    });
  };
  owned_[topic].shards = handle_.subscribe<ShardNode>(shards, MOST_SHARDS, hear);
}

void NodeBase::warnOfRivals(Status& status) const {
  std::vector<std::string> all;
  for (const OwnedTopic& topic : owned_) {
    const bool is_sharded = topic.shards && topic.shards.getNumPublishers() > 0;
    all.push_back(describeRivals({topic.subscriber}, is_sharded ? topic.announced : 1));
  }
  const std::string rivals = joinRivals(all);
  if (!rivals.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        rivals + ": the last message wins");
}

}  // namespace vegetation_sim
