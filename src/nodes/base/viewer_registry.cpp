// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/viewer_registry.h"

#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

void ViewerRegistry::hear(const Viewer& message, const tf2_ros::Buffer& buffer,
                          const std::string& frame_id, Nanoseconds stamp) {
  fromMsg(message);  // checks it
  Viewer in_world = message;
  in_world.pose =
      toMsg(compose(poseInWorld(buffer, frame_id, message.header.frame_id), fromMsg(message.pose)));
  if (seen_.size() >= MOST && !seen_.count(message.id))
    throw InvalidInput("viewer '" + message.id + "' is one more than the " + std::to_string(MOST) +
                       " allowed at once");
  seen_[message.id] = {fromMsg(in_world).eye, stamp};
}

std::vector<Viewpoint> ViewerRegistry::eyesAt(Nanoseconds stamp) {
  std::vector<Viewpoint> out;
  for (auto entry = seen_.begin(); entry != seen_.end();) {
    if (entry->second.stamp == 0) entry->second.stamp = stamp;  // spoke before the first tick
    if (secondsBetween(entry->second.stamp, stamp) > LIFE) {
      entry = seen_.erase(entry);
      continue;
    }
    out.push_back(entry->second.eye);
    ++entry;
  }
  return out;
}

}  // namespace vegetation_sim
