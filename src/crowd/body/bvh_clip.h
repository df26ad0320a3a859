// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "crowd/body/bvh.h"
#include "crowd/body/motion_style.h"

namespace vegetation_sim::crowd {

/// A file of motion data shows walking, of which one cycle is cut out that begins when the left
/// heel strikes; standing, of which all frames are a cycle; or turning at a steady rate, of which
/// yaw and roll of the trunk relative to the hips count.
enum class ClipKind { WALK, STAND, TURN };

/// Maps motion data to the angles of a body by the names of joints, in the usual spellings
/// (LeftUpLeg, LeftHip, lThigh, mixamorig:LeftUpLeg). The axis y of the file is up. Angles follow
/// from the positions of joints, so rest pose and order of rotations do not matter. Cycles that do
/// not close are bent until they do. @throws InvalidInput with the missing joint.
Clip makeClip(const BvhMotion& motion, ClipKind kind, const std::string& name);

}  // namespace vegetation_sim::crowd
