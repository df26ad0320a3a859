// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::terrain {

/// Finds where a ray first meets the ground from above, within 1 mm. The steps along the ray are
/// half the distance between samples, so a narrower ridge may be missed.
/// @param direction has any length but zero. @param reach is the largest distance along the ray
/// [m].
/// @return false if it meets none within `reach`, or starts below the ground.
bool meetGround(const HeightMap& ground, const Vec3& origin, const Vec3& direction, double reach,
                Vec3& place);

}  // namespace vegetation_sim::terrain
