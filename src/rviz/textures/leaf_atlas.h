// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rviz/textures/leaf_texture.h"

namespace vegetation_sim::view {

/// The four clusters in the order of LeafShape from left to right, their boughs below, with mipmaps
/// that keep each picture's coverage, so that crowns do not thin out with distance.
std::vector<Image> leafAtlas(int edge);
/// A place in one picture, from the lower left corner (0, 0) to (1, 1), as a place in the atlas.
std::array<float, 2> leafAtlasPlace(int shape, bool bough, const std::array<float, 2>& at);

/// Mipmaps of which as much passes the test against alpha as of the picture.
std::vector<Image> coveredMipmaps(const Image& picture, int smallest);

}  // namespace vegetation_sim::view
