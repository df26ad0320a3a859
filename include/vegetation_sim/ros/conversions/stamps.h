// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Stamps of messages as integers and back; what ROS time cannot hold, below zero, becomes zero.
Nanoseconds fromMsg(const ros::Time& stamp);
ros::Time toStamp(Nanoseconds stamp);

}  // namespace vegetation_sim
