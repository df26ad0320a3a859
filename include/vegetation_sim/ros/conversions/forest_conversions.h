// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/BranchTransforms.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/ForestState.h>
#include <vegetation_sim/SensorInterest.h>
#include <vegetation_sim/Viewer.h>

#include <string>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/tree/state/viewer.h"

namespace vegetation_sim {

/// The header is left to the sender.
ForestLayout toMsg(const forest::Layout& layout);
/// @throws InvalidInput with all faults: species that do not parse, numbers out of range.
forest::Layout fromMsg(const ForestLayout& message);

TreeSeed toMsg(const forest::TreeSeed& seed);
forest::TreeSeed fromMsg(const TreeSeed& message);

PromotedBranch toMsg(const forest::PromotedBranch& branch);
forest::PromotedBranch fromMsg(const PromotedBranch& message);

ForestState toMsg(const forest::StateUpdate& update);
/// @throws InvalidInput for a level, blend or stamp that cannot be.
forest::StateUpdate fromMsg(const ForestState& message);

/// Poses of a tree in the world from poses in the tree's frame.
BranchTransforms toMsg(std::uint32_t tree, const Vec3& foot, const std::vector<Pose>& poses);

geometry_msgs::Pose toMsg(const Vec3& foot, const Pose& pose);

/// A viewer in the world frame (message's pose already transformed there).
/// @throws InvalidInput for NaN, an unnormalised quaternion, a field of view or height out of
/// range.
forest::Viewer fromMsg(const Viewer& message);

/// A sensor, in the frame of the message. @throws InvalidInput for values out of range.
forest::Sensor fromMsg(const SensorInterest& message);
SensorInterest toMsg(const forest::Sensor& sensor);

}  // namespace vegetation_sim
