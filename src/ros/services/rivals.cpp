// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/rivals.h"

namespace vegetation_sim {

std::string describeRivals(const std::vector<ros::Subscriber>& subscribers, std::uint32_t owners) {
  std::string out;
  for (const ros::Subscriber& subscriber : subscribers) {
    const std::uint32_t count = subscriber.getNumPublishers();
    if (count > owners)
      out += (out.empty() ? "" : ", ") + std::to_string(count) + " publishers of " +
             subscriber.getTopic();
  }
  return out;
}

}  // namespace vegetation_sim
