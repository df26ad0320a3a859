// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/wind/wind_source.h"

#include <boost/bind/bind.hpp>
#include <stdexcept>

#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim::view {

WindSource::WindSource(ros::NodeHandle nh, const std::string& topic)
    : ground_(nh),
      status_{false, "No wind on " + nh.resolveName(topic)},
      subscriber_(nh.subscribe(topic, 1, &WindSource::take, this)) {}

void WindSource::take(const WindField& message) {
  try {
    wind_ = fromMsg(message);
  } catch (const std::exception& error) {
    status_ = {false, std::string("Refused a message: ") + error.what()};
    return;
  }
  ++messages_;
  frame_ = message.header.frame_id;
  status_ = {true, std::to_string(message.primitives.size()) + " primitives"};
}

}  // namespace vegetation_sim::view
