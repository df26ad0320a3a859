// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::view {

/// Length of wood that the height of a bark picture shows [m].
constexpr float BARK_PERIOD = 2.f;

/// Bark as lightness, mean about 0.85: once around from left to right, BARK_PERIOD of wood in
/// height. The kind of tree is told by its leaves: fissures (broad, long), plates (needle),
/// lenticels (small).
Image barkPicture(forest::LeafShape shape, int columns);

/// The four barks side by side, in the order of LeafShape, and mirrored below: so it repeats
/// without a seam, of 2 BARK_PERIOD, where renderers are slow to mirror. [2 edge x edge]
Image barkAtlas(int edge);
/// Horizontal place in the atlas of `around` (0 to 1) for a shape.
float barkAtlasU(int shape, float around);

}  // namespace vegetation_sim::view
