// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/BranchForce.h>
#include <vegetation_sim/BranchGrab.h>
#include <vegetation_sim/ForestBody.h>

#include "tree/physical/interaction.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

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
