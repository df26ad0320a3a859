// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// Paints the repeating detail of the ground, of which each channel has a mean of one half: red,
/// green and blue are litter of leaves and twigs, alpha is turf seen from above.
/// @param edge must be a power of two.
Image grainPicture(int edge);

}  // namespace vegetation_sim::view
