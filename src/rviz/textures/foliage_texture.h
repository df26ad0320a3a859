// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// What a leaf of a canopy is cut from; the foot of each is at the top of its picture (v = 0).
enum class LeafCut { LEAF, SPRIG, RIBBON, PLAIN };

/// The cuts side by side: lightness in the colour, mean about 0.8, their outlines in alpha, which
/// keeps its coverage in the smaller versions.
std::vector<Image> foliageAtlas(int edge);
/// A place in one picture, u across and v along from 0 to 1, as a place in the atlas.
std::array<float, 2> foliagePlace(LeafCut cut, float u, float v);

}  // namespace vegetation_sim::view
