// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/frame_lookup.h"

#include <algorithm>
#include <utility>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double POLL = 5e-4;  // [s] between two looks

}  // namespace

FrameLookup::WallClock FrameLookup::systemClock() {
  return {[] { return ros::WallTime::now().toSec(); },
          [](double seconds) { ros::WallDuration(seconds).sleep(); }};
}

FrameLookup::FrameLookup(const tf2_ros::Buffer& buffer, std::string world, double wait,
                         WallClock clock)
    : buffer_(buffer), world_(std::move(world)), wait_(wait), clock_(std::move(clock)) {}

void FrameLookup::begin(Nanoseconds tick) {
  if (tick < tick_) missing_.clear();
  tick_ = tick;
  deadline_ = clock_.now() + wait_;
}

// A transform later than the tick may or may not have come, so it is none.
std::optional<geometry_msgs::TransformStamped> FrameLookup::newestOf(
    const std::string& frame) const {
  try {
    geometry_msgs::TransformStamped out = buffer_.lookupTransform(world_, frame, ros::Time(0));
    if (fromMsg(out.header.stamp) <= tick_) return out;
  } catch (const tf2::TransformException&) {
  }
  return std::nullopt;
}

bool FrameLookup::awaits(const std::string& frame) const {
  while (!buffer_.canTransform(world_, frame, toStamp(tick_))) {
    if (clock_.now() >= deadline_) return false;
    clock_.sleep(POLL);
  }
  return true;
}

void FrameLookup::giveUp(const std::string& frame) {
  Missing& missing = missing_.try_emplace(frame, Missing{tick_, tick_, tick_, {}}).first->second;
  const Nanoseconds longest = fromSeconds(std::max(LONGEST_PAUSE, PAUSE_PER_WAIT * wait_));
  missing.tried = tick_;
  missing.again = tick_ + std::min(tick_ - missing.since, longest);
  if (auto newest = newestOf(frame)) missing.last = std::move(newest);
}

geometry_msgs::TransformStamped FrameLookup::find(const std::string& frame) {
  if (!(wait_ > 0.0)) return buffer_.lookupTransform(world_, frame, ros::Time(0));
  auto missing = missing_.find(frame);
  // A frame may be looked up several times in a tick.
  const bool pauses = missing != missing_.end() &&
                      (tick_ == missing->second.tried || tick_ < missing->second.again);
  if (!pauses && awaits(frame)) {
    missing_.erase(frame);
    return buffer_.lookupTransform(world_, frame, toStamp(tick_));
  }
  if (!pauses) giveUp(frame);
  ++late_;
  missing = missing_.find(frame);
  if (!missing->second.last)
    throw tf2::LookupException(inQuotes(frame) + " has no transform to " + inQuotes(world_) +
                               " in time");
  return *missing->second.last;
}

}  // namespace vegetation_sim
