// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>
#include <vegetation_sim/BranchForce.h>
#include <vegetation_sim/BranchGrab.h>
#include <vegetation_sim/ForestBody.h>

#include "vegetation_sim/forest/interaction.h"

namespace vegetation_sim {

Vec3 fromMsg(const geometry_msgs::Point& point);
Vec3 fromMsg(const geometry_msgs::Vector3& vector);
geometry_msgs::Point toPoint(const Vec3& point);
geometry_msgs::Vector3 toVector(const Vec3& vector);
Pose fromMsg(const geometry_msgs::Pose& pose);
geometry_msgs::Pose toMsg(const Pose& pose);
Pose fromMsg(const geometry_msgs::Transform& transform);

/// Pose `inner`, given in the frame `outer`, in the frame that `outer` is given in.
Pose compose(const Pose& outer, const Pose& inner);
Pose inverse(const Pose& pose);
Vec3 transformed(const Pose& frame, const Vec3& point);

/// @throws InvalidInput with all values that are not finite or out of range.
forest::Grab fromMsg(const BranchGrab& message);
/// `holder` and `offset` are left to the sender.
BranchGrab toMsg(const forest::Grab& grab);

/// @param start tick at which it begins. @throws InvalidInput
forest::Push fromMsg(const BranchForce& message, Nanoseconds start);

/// @throws InvalidInput for an unknown shape or numbers that are not finite.
forest::Body fromMsg(const ForestBody& message);

/// @param in_frame pose of the body in its frame.
ForestBody toMsg(const forest::Body& body, const Pose& in_frame);

/// Force and torque of a reaction as geometry_msgs/Wrench wants them: in the axes of `frame` (world
/// pose) and about its origin.
struct FramedWrench {
  Vec3 force, torque;
};
FramedWrench wrenchIn(const Pose& frame, const forest::Reaction& reaction);

}  // namespace vegetation_sim
