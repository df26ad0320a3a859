// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::view {

/// One cluster of leaves on its twig, or a bough of several, foot at the middle of the lower edge:
/// lightness in the colour (about 0.8, to be multiplied with the tree's own), the leaves in alpha.
Image leafPicture(forest::LeafShape shape, bool bough, int edge);

/// What alpha has to reach to be drawn.
constexpr float ALPHA_LIMIT = 0.5f;
/// Fraction of the picture that passes that test.
double coverage(const Image& picture);

}  // namespace vegetation_sim::view
