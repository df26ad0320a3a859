// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/listeners/sensor_registry.h"

#include "ros/services/request_checks.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

std::vector<InterestArea> discsOf(const std::vector<Viewpoint>& viewers, double range) {
  constexpr double EVERYWHERE = 1e9;  // [m]
  std::vector<InterestArea> out;
  for (const Viewpoint& viewer : viewers)
    out.push_back({viewer.position.x(), viewer.position.y(), range > 0.0 ? range : EVERYWHERE});
  return out;
}

void SensorRegistry::hear(const SensorInterest& message, const tf2_ros::Buffer& buffer,
                          const std::string& frame_id, Nanoseconds stamp) {
  const forest::Sensor sensor = fromMsg(message);
  const std::string& frame = message.header.frame_id;
  Vec3 place = sensor.position;
  if (!frame.empty() && frame != frame_id)
    place = transformed(poseInWorld(buffer, frame_id, frame), place);
  discs_.put("sensor", sensor.id, {place.x(), place.y(), sensor.range + REACH}, stamp);
}

}  // namespace vegetation_sim
