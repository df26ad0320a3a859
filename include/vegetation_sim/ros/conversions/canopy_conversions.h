// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CanopyLayout.h>
#include <vegetation_sim/CanopyState.h>

#include <string>
#include <vector>

#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// The header is left to the sender.
CanopyLayout toMsg(const canopy::Layout& layout);
/// @param folders whose files the message may name, besides those of packages; without it they are
/// those of the parameter resource_folders. @throws InvalidInput with all faults: a law that does
/// not parse, numbers out of range, files elsewhere, and if the hash is another than the sender's.
canopy::Layout fromMsg(const CanopyLayout& message, const std::vector<std::string>& folders);
canopy::Layout fromMsg(const CanopyLayout& message);

/// The header's frame is left to the sender.
CanopyState toMsg(const canopy::StateUpdate& update);
/// Sizes of the frame are Replica's to check. @throws InvalidInput for what cannot be.
canopy::StateUpdate fromMsg(const CanopyState& message);

/// An eye in the world. @throws InvalidInput for what is not finite or no unit quaternion.
canopy::CutView eyeFromMsg(const geometry_msgs::Pose& pose);
geometry_msgs::Pose eyeToMsg(const canopy::CutView& eye);

}  // namespace vegetation_sim
