// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/forest/species.h"
#include "vegetation_sim/rviz/picture.h"

namespace vegetation_sim::view {

/// One cluster of leaves on its twig, foot at the middle of the lower edge: lightness in the colour
/// (about 0.8, to be multiplied with the tree's own), the leaves in alpha.
Picture leafPicture(forest::LeafShape shape, int edge);

/// Fraction of the picture that passes the alpha test, alpha >= 0.5.
double coverage(const Picture& picture);

/// The four clusters side by side, two by two in the order of LeafShape, with mipmaps that keep
/// each cluster's coverage, so that crowns do not thin out with distance.
std::vector<Picture> leafAtlas(int edge);
/// Corner of a shape's quarter in the atlas.
std::array<float, 2> leafAtlasCorner(int shape);

}  // namespace vegetation_sim::view
