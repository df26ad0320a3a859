// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <string>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// A TRIANGLE_LIST of `points` black, clear points at the origin; each has a colour of its own.
visualization_msgs::Marker triangleList(const std::string& ns, int id, std::size_t points);
/// A list of which no point is in use is taken away: rviz works on triangles without area as on
/// others.
void takeAwayIfUnused(visualization_msgs::Marker& list, std::size_t used);
std_msgs::ColorRGBA opaque(const Vec3& rgb);

}  // namespace vegetation_sim
