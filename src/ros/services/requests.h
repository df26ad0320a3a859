// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <string>

#include "ros/time/tick_clock.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// Where a request's frame is in the world's; an empty one is the world's itself.
/// @throws InvalidInput naming both if tf does not tell.
Pose poseInWorld(const tf2_ros::Buffer& buffer, const std::string& world, const std::string& frame,
                 const ros::Time& stamp = ros::Time(0));

/// @throws InvalidInput naming both if a message is not in the world's frame.
void checkFrame(const std::string& frame, const std::string& world);

/// When a request takes effect: at its stamp if that is yet to come, else at the next tick, which
/// is zero. @throws InvalidInput for a stamp more than a minute ahead.
ros::Time effectOf(const ros::Time& stamp, const TickClock& clock);

}  // namespace vegetation_sim
