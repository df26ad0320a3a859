// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/rivals.h"

namespace vegetation_sim {

std::string describeRivals(const std::vector<ros::Subscriber>& subscribers, std::uint32_t owners) {
  std::vector<std::string> out;
  for (const ros::Subscriber& subscriber : subscribers) {
    const std::uint32_t count = subscriber.getNumPublishers();
    if (count > owners)
      out.push_back(std::to_string(count) + " publishers of " + subscriber.getTopic());
  }
  return joinRivals(out);
}

std::string joinRivals(const std::vector<std::string>& rivals) {
  std::string out;
  for (const std::string& rival : rivals)
    if (!rival.empty()) out += (out.empty() ? "" : ", ") + rival;
  return out;
}

}  // namespace vegetation_sim
