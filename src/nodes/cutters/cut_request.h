// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <vegetation_sim/GrassCut.h>

#include "nodes/cutters/cutter_follower.h"
#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/grass/tread/cut_map.h"

namespace vegetation_sim {

/// Returns the area of a request in the world frame. @param to_world pose of the frame of the
/// request. @throws InvalidInput with all values that are out of range.
grass::CutArea areaOf(const GrassCut& cut, const Pose& to_world);

/// Answers the service that switches all tools on or off, except in a replay, whose cuts are
/// recorded. @return whether they were switched.
bool switchCutters(const std_srvs::SetBool::Request& request, bool replay, CutterFollower& cutters,
                   std_srvs::SetBool::Response& response);

/// Checks the area that a tool has swept. @throws InvalidInput
void checkSwept(const grass::CutArea& area);

}  // namespace vegetation_sim
