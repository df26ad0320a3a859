// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/border_inbox.h"

#include <ros/time.h>
#include <ros/transport_hints.h>

#include <algorithm>
#include <utility>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double BORDER_POLL = 5e-4;  // [s] between two looks
constexpr unsigned BORDER_QUEUE = 1000;
constexpr std::size_t MOST_BORDERS = 100;  // of one shard that wait for their tick

}  // namespace

BorderInbox::BorderInbox(ros::NodeHandle handle, const Shard& shard, double wait)
    : shard_(shard), wait_(wait) {
  clear();
  handle.setCallbackQueue(&queue_);
  const boost::function<void(const CrowdBorder&)> callback = [this](const CrowdBorder& message) {
    onBorder(message);
  };
  subscriber_ =
      handle.subscribe<CrowdBorder>("agents/border", BORDER_QUEUE, callback, ros::VoidConstPtr(),
                                    ros::TransportHints().tcpNoDelay());
}

void BorderInbox::clear() {
  waiting_.clear();
  newest_.clear();
  for (std::uint32_t i = 0; i < shard_.count; ++i)
    if (i != shard_.index) awaited_.insert(i);
}

void BorderInbox::onBorder(const CrowdBorder& message) {
  const std::uint32_t shard = message.shard;
  if (shard == shard_.index || shard >= shard_.count || message.shards != shard_.count) return;
  std::vector<CrowdBorder>& waiting = waiting_[shard];
  waiting.push_back(message);
  if (waiting.size() > MOST_BORDERS) waiting.erase(waiting.begin());
  newest_[shard] = fromMsg(message.header.stamp);
  awaited_.insert(shard);
}

bool BorderInbox::hasAll(Nanoseconds before) const {
  return std::all_of(awaited_.begin(), awaited_.end(), [&](std::uint32_t shard) {
    const auto found = newest_.find(shard);
    return found != newest_.end() && found->second >= before;
  });
}

std::vector<CrowdBorder> BorderInbox::take(Nanoseconds before, Nanoseconds now) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(wait_);
  queue_.callAvailable();
  while (!hasAll(before) && ros::WallTime::now() < deadline) {
    ros::WallDuration(BORDER_POLL).sleep();
    queue_.callAvailable();
  }
  for (auto shard = awaited_.begin(); shard != awaited_.end();) {
    const auto found = newest_.find(*shard);
    const bool has_come = found != newest_.end() && found->second >= before;
    late_ += has_come ? 0 : 1;
    shard = has_come ? std::next(shard) : awaited_.erase(shard);
  }
  std::vector<CrowdBorder> out;
  for (auto& [shard, waiting] : waiting_) {
    const auto later = std::find_if(waiting.begin(), waiting.end(), [&](const CrowdBorder& one) {
      return fromMsg(one.header.stamp) >= now;
    });
    if (later == waiting.begin()) continue;
    out.push_back(std::move(*std::prev(later)));
    waiting.erase(waiting.begin(), later);
  }
  return out;
}

}  // namespace vegetation_sim
