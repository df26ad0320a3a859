// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// Images from which the leaves of a canopy are cut; the foot of each is at the top (v = 0).
/// A PUFF of a cloud is dots that are dense in its middle.
enum class LeafCut { LEAF, SPRIG, RIBBON, PLAIN, PUFF };

/// Paints the images side by side: lightness with a mean of about 0.8 in the colour, outlines in
/// alpha. Mipmaps keep the coverage.
std::vector<Image> foliageAtlas(int edge);
/// Number of other pictures that an atlas has room for, and the place of the first.
constexpr int MOST_PICTURES = 11;
int firstPicturePlace();
/// Adds a picture of the edge of the atlas at one of those places, whose foot is below (v = 1).
void addToAtlas(const Image& picture, int place, std::vector<Image>& atlas);
/// Converts a place in one image, u across and v along from 0 to 1, to atlas coordinates.
std::array<float, 2> foliagePlace(LeafCut cut, float u, float v);
std::array<float, 2> foliagePlace(int place, float u, float v);

}  // namespace vegetation_sim::view
