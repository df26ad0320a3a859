// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/BranchBreak.h>
#include <vegetation_sim/BranchForce.h>
#include <vegetation_sim/BranchGrab.h>
#include <vegetation_sim/BrokenBranch.h>
#include <vegetation_sim/ContactForce.h>
#include <vegetation_sim/ForestBody.h>
#include <vegetation_sim/PlantContact.h>

#include "forest/physics/forest_physics.h"
#include "tree/physical/interaction.h"
#include "vegetation_sim/canopy/contact/fibres.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

forest::Grab fromMsg(const BranchGrab& message);
BranchGrab toMsg(const forest::Grab& grab);

/// A push from 0 until its duration. @throws InvalidInput for a duration out of range.
forest::Push fromMsg(const BranchForce& message);
BranchForce toMsg(const forest::Push& push);

BrokenBranch toMsg(const forest::BrokenBranch& broken);
forest::BrokenBranch fromMsg(const BrokenBranch& message);
/// Left to the caller: the frame of the header.
BranchBreak toMsg(const forest::Break& broken);

forest::Body fromMsg(const ForestBody& message);
ForestBody toMsg(const forest::Body& body);

/// Force and torque of a reaction as geometry_msgs/Wrench wants them: in the axes of `frame` (world
/// pose) and about its origin.
struct FramedWrench {
  Vec3 force, torque;
};
FramedWrench wrenchIn(const Pose& frame, const forest::Reaction& reaction);

/// @param frame world pose of the frame of the holder or body.
ContactForce toMsg(const forest::Reaction& reaction, const Pose& frame);
PlantContact toMsg(const canopy::PushForce& force, const Pose& frame);

}  // namespace vegetation_sim
