// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/requests.h"

#include <tf2/exceptions.h>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double FARTHEST_AHEAD = 60.0;  // [s]

}  // namespace

Pose poseInWorld(const tf2_ros::Buffer& buffer, const std::string& world, const std::string& frame,
                 const ros::Time& stamp) {
  if (frame.empty() || frame == world) return {};
  try {
    return fromMsg(buffer.lookupTransform(world, frame, stamp).transform);
  } catch (const tf2::TransformException& error) {
    throw InvalidInput(
        "frame_id = '" + frame + "' is not known in '" + world + "': " + error.what(),
        FaultCode::NO_TRANSFORM);
  }
}

void checkFrame(const std::string& frame, const std::string& world) {
  if (frame != world)
    throw InvalidInput("frame_id = '" + frame + "', allowed is the world frame of this node, '" +
                       world + "'");
}

ros::Time effectOf(const ros::Time& stamp, const TickClock& clock) {
  if (stamp.isZero() || !clock.hasBegun()) return stamp;
  const double ahead = secondsBetween(clock.stamp(), fromMsg(stamp));
  if (ahead > FARTHEST_AHEAD)
    throw InvalidInput("stamp is " + std::to_string(ahead) + " s ahead, allowed are " +
                       std::to_string(FARTHEST_AHEAD) + " s");
  return ahead > 0.0 ? stamp : ros::Time();
}

}  // namespace vegetation_sim
