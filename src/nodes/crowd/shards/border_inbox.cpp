// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/shards/border_inbox.h"

#include <ros/time.h>

#include <algorithm>
#include <utility>

#include "ros/services/subscriptions.h"

namespace vegetation_sim {
namespace {

constexpr double BORDER_POLL = 5e-4;  // [s] between two looks
constexpr double FIRST_WAIT = 0.5;    // of the first tick, until shards that run connect [s]
constexpr unsigned BORDER_QUEUE = 1000;

}  // namespace

BorderInbox::BorderInbox(
    ros::NodeHandle handle, const Shard& shard, double wait,
    std::function<bool(std::uint32_t shard, const std::string& process)> is_from_shard)
    : wait_(wait), borders_(shard) {
  handle.setCallbackQueue(&queue_);
  using Event = ros::MessageEvent<CrowdBorder const>;
  const boost::function<void(const Event&)> callback =
      [this, is_from_shard = std::move(is_from_shard)](const Event& event) {
        if (is_from_shard(event.getMessage()->shard, event.getPublisherName()))
          borders_.add(*event.getMessage());
      };
  subscriber_ = subscribeWithoutDelay<CrowdBorder>(handle, "agents/border", BORDER_QUEUE, callback);
}

std::vector<CrowdBorder> BorderInbox::take(Nanoseconds before, Nanoseconds now) {
  const double wait = before == 0 ? std::max(wait_, FIRST_WAIT) : wait_;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(wait);
  borders_.beginTick(before, now);
  queue_.callAvailable();
  while (!borders_.hasAll() && ros::WallTime::now() < deadline) {
    ros::WallDuration(BORDER_POLL).sleep();
    queue_.callAvailable();
  }
  late_ += borders_.dropLate();
  return borders_.take();
}

}  // namespace vegetation_sim
