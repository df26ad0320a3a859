// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_wind.h"

#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

void SubscribedWind::subscribe(ros::NodeHandle handle, const std::string& topic) {
  status_ = {false, "No wind on " + handle.resolveName(topic) + ": still air"};
  subscribeState(handle, topic, 10);
}

bool SubscribedWind::accepts(const WindField& message) {
  return receive("wind", status_, [&] {
    requireSoon(message.header.stamp);
    requireFrame(message.header.frame_id);
    fromMsg(message);
    return status_;
  });
}

void SubscribedWind::apply(const WindField& message) {
  receive("wind", status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    field_ = fromMsg(message);
    frame_ = message.header.frame_id;
    ++messages_;
    if (on_change_) on_change_(field_);
    return {true, std::to_string(message.primitives.size()) + " primitives"};
  });
}

}  // namespace vegetation_sim
