// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// What blows at a stamp, for rviz: discs, fronts, cores and spheres of influence where they are
/// now, and an arrow along the air with 1 m for 1 m/s. Ids are those of the primitives.
/// @param lifetime after which a marker that is not sent again disappears [s].
visualization_msgs::MarkerArray windMarkers(const wind::Field& field, const std::string& frame_id,
                                            Nanoseconds stamp, double lifetime);

}  // namespace vegetation_sim
