// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>

#include <string>

#include "ros/time/tick_clock.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// Returns the transform of a frame, which the field `name` of a request gives, to the world frame.
/// @throws InvalidInput that names both frames, and those there are, if tf has no transform.
geometry_msgs::TransformStamped transformToWorld(const tf2_ros::Buffer& buffer,
                                                 const std::string& world, const std::string& frame,
                                                 const ros::Time& stamp, const char* name);

/// Returns the pose of a request's frame in the world frame; an empty name is the world frame.
/// @throws InvalidInput as transformToWorld.
Pose poseInWorld(const tf2_ros::Buffer& buffer, const std::string& world, const std::string& frame,
                 const ros::Time& stamp = ros::Time(0));

/// @throws InvalidInput that names both if a message is not in the world frame.
void checkFrame(const std::string& frame, const std::string& world);

/// @throws InvalidInput that names the field and the range if a coordinate of a request [m] is
/// outside the range or not finite.
void checkFinite(const char* name, Vec3 value, Range range);

/// Returns when an input takes effect: its stamp if that is in the future, else zero for the next
/// tick. @throws InvalidInput for a stamp more than FARTHEST_AHEAD ahead. Before the clock has
/// begun, any stamp is returned; the queue of inputs drops what is too far ahead of the first tick.
ros::Time effectOf(const ros::Time& stamp, const TickClock& clock);
/// Says when a request takes effect, for its answer.
std::string describeEffect(const ros::Time& effect);

}  // namespace vegetation_sim
