// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/request_checks.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "ros/services/stamp_limits.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_NAMES = 8;

std::string describeFrames(const tf2_ros::Buffer& buffer) {
  std::vector<std::string> frames;
  buffer._getFrameStrings(frames);
  if (frames.empty()) return "tf has no frames yet";
  std::sort(frames.begin(), frames.end());
  std::string out = "tf knows ";
  for (std::size_t i = 0; i < std::min(frames.size(), MOST_NAMES); ++i)
    out += (i == 0 ? "" : ", ") + inQuotes(frames[i]);
  if (frames.size() > MOST_NAMES)
    out += " and " + std::to_string(frames.size() - MOST_NAMES) + " others";
  return out;
}

}  // namespace

geometry_msgs::TransformStamped transformToWorld(const tf2_ros::Buffer& buffer,
                                                 const std::string& world, const std::string& frame,
                                                 const ros::Time& stamp, const char* name) {
  try {
    return buffer.lookupTransform(world, frame, stamp);
  } catch (const tf2::TransformException& error) {
    throw InvalidInput(std::string(name) + " = " + inQuotes(frame) + " is not known in " +
                           inQuotes(world) + ": " + error.what() + "; " + describeFrames(buffer),
                       FaultCode::NO_TRANSFORM);
  }
}

Pose poseInWorld(const tf2_ros::Buffer& buffer, const std::string& world, const std::string& frame,
                 const ros::Time& stamp) {
  if (frame.empty() || frame == world) return {};
  return fromMsg(transformToWorld(buffer, world, frame, stamp, "frame_id").transform);
}

void checkFrame(const std::string& frame, const std::string& world) {
  if (frame != world)
    throw InvalidInput("frame_id = " + inQuotes(frame) +
                       ", allowed is the world frame of this node, " + inQuotes(world));
}

void checkFinite(const char* name, Vec3 value, Range range) {
  Faults faults;
  FieldChecker("", faults).vector(name, value, "m", range);
  faults.throwIfAny();
}

ros::Time effectOf(const ros::Time& stamp, const TickClock& clock) {
  if (stamp.isZero() || !clock.hasBegun()) return stamp;
  requireNear(fromMsg(stamp), clock.stamp());
  return fromMsg(stamp) > clock.stamp() ? stamp : ros::Time();
}

std::string describeEffect(const ros::Time& effect) {
  if (effect.isZero()) return "takes effect at the next tick";
  char out[64];
  std::snprintf(out, sizeof out, "takes effect at %.3f s", effect.toSec());
  return out;
}

}  // namespace vegetation_sim
