// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/frame_lookup.h"

#include <utility>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double PAUSE = 5e-4;  // [s] between two looks

}  // namespace

FrameLookup::FrameLookup(const tf2_ros::Buffer& buffer, std::string world, double wait)
    : buffer_(buffer), world_(std::move(world)), wait_(wait) {}

void FrameLookup::begin(Nanoseconds tick) {
  tick_ = tick;
  deadline_ = ros::WallTime::now() + ros::WallDuration(wait_);
}

// Returns the stamp of the newest transform, 0 if there is none.
ros::Time FrameLookup::newestOf(const std::string& frame) const {
  try {
    return buffer_.lookupTransform(world_, frame, ros::Time(0)).header.stamp;
  } catch (const tf2::TransformException&) {
    return {};
  }
}

bool FrameLookup::awaits(const std::string& frame, const ros::Time& stamp) {
  const auto given_up = given_up_.find(frame);
  if (given_up != given_up_.end() && given_up->second == newestOf(frame))
    return buffer_.canTransform(world_, frame, stamp);
  while (!buffer_.canTransform(world_, frame, stamp)) {
    if (ros::WallTime::now() >= deadline_) {
      given_up_[frame] = newestOf(frame);
      return false;
    }
    ros::WallDuration(PAUSE).sleep();
  }
  given_up_.erase(frame);
  return true;
}

geometry_msgs::TransformStamped FrameLookup::find(const std::string& frame) {
  const ros::Time stamp = toStamp(tick_);
  if (wait_ > 0.0) {
    if (awaits(frame, stamp)) return buffer_.lookupTransform(world_, frame, stamp);
    ++late_;
  }
  return buffer_.lookupTransform(world_, frame, ros::Time(0));
}

}  // namespace vegetation_sim
