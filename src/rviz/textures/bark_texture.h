// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::view {

/// Length of wood that the height of a bark texture covers [m].
constexpr float BARK_PERIOD = 2.f;

/// Paints bark as lightness with a mean of about 0.85. The width is the circumference, the height
/// is BARK_PERIOD. The leaf shape selects fissures (broad, long), plates (needle) or lenticels
/// (small).
Image barkPicture(forest::LeafShape shape, int columns);

/// Paints the four barks side by side in the order of LeafShape, and mirrored below, so that the
/// image of 2 BARK_PERIOD repeats without a seam. [2 edge x edge]
Image barkAtlas(int edge);
/// Returns the horizontal atlas coordinate of `around` (0 to 1) for a shape.
float barkAtlasU(forest::LeafShape shape, float around);

}  // namespace vegetation_sim::view
