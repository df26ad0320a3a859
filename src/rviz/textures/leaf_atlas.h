// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rviz/textures/leaf_texture.h"

namespace vegetation_sim::view {

/// Paints the four clusters in the order of LeafShape from left to right, their boughs below.
/// Mipmaps keep the coverage of each image, so that crowns do not thin out with distance.
std::vector<Image> leafAtlas(int edge);
/// Converts a place in one image, from the lower left corner (0, 0) to (1, 1), to atlas
/// coordinates.
std::array<float, 2> leafAtlasPlace(forest::LeafShape shape, bool bough,
                                    const std::array<float, 2>& at);

/// Returns mipmaps of which the same fraction passes the alpha test as of the image.
std::vector<Image> coveredMipmaps(const Image& picture, int smallest);

}  // namespace vegetation_sim::view
