// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/subscriber.h>

#include <string>
#include <vector>

namespace vegetation_sim {

/// Names the topics of these subscribers that have more than one publisher, though each has one
/// owner: the last message wins, so that two of them alternate. Empty if there are none.
std::string describeRivals(const std::vector<ros::Subscriber>& subscribers);

}  // namespace vegetation_sim
