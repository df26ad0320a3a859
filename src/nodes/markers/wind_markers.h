// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// Builds the markers of a wind field at a stamp: discs, fronts, cores and spheres of influence,
/// and an arrow along the velocity, 1 m for 1 m/s. Markers have the ids of their primitives.
/// @param lifetime [s] after which a marker disappears unless it is published again.
visualization_msgs::MarkerArray windMarkers(const wind::Field& field, const std::string& frame_id,
                                            Nanoseconds stamp, double lifetime);

}  // namespace vegetation_sim
