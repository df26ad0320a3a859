// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/subscriber.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vegetation_sim {

/// Names the topics of these subscribers that have more publishers than owners: the last message
/// wins, so that two of them alternate. Empty if there are none. @param owners of each topic.
std::string describeRivals(const std::vector<ros::Subscriber>& subscribers,
                           std::uint32_t owners = 1);
/// Joins such texts.
std::string joinRivals(const std::vector<std::string>& rivals);

}  // namespace vegetation_sim
