// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/listeners/viewer_registry.h"

#include "ros/services/request_checks.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

void ViewerRegistry::hear(const Viewer& message, const tf2_ros::Buffer& buffer,
                          const std::string& frame_id, Nanoseconds stamp) {
  fromMsg(message);  // checks it
  Viewer in_world = message;
  in_world.pose =
      toMsg(compose(poseInWorld(buffer, frame_id, message.header.frame_id), fromMsg(message.pose)));
  eyes_.put("viewer", message.id, fromMsg(in_world).eye, stamp);
}

}  // namespace vegetation_sim
