// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/forest/species.h"
#include "vegetation_sim/rviz/picture.h"

namespace vegetation_sim::view {

/// One cluster of leaves on its twig, or a bough of several, foot at the middle of the lower edge:
/// lightness in the colour (about 0.8, to be multiplied with the tree's own), the leaves in alpha.
Picture leafPicture(forest::LeafShape shape, bool bough, int edge);

/// Fraction of the picture that passes the alpha test, alpha >= 0.5.
double coverage(const Picture& picture);

/// The four clusters in the order of LeafShape from left to right, their boughs below, with mipmaps
/// that keep each picture's coverage, so that crowns do not thin out with distance.
std::vector<Picture> leafAtlas(int edge);
/// A place in one picture, u and v from 0 to 1, as a place in the atlas.
std::array<float, 2> leafAtlasPlace(int shape, bool bough, const std::array<float, 2>& uv);

}  // namespace vegetation_sim::view
