// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::view {

/// Paints one cluster of leaves on its twig, or a bough of several, with the foot at the middle of
/// the lower edge: lightness of about 0.8 in the colour (a factor of the tree's colour), leaves in
/// alpha.
Image leafPicture(forest::LeafShape shape, bool bough, int edge);

/// Pixels with at least this alpha are drawn.
constexpr float ALPHA_LIMIT = 0.5f;
/// Returns the fraction of the image that passes the alpha test.
double coverage(const Image& picture);

}  // namespace vegetation_sim::view
