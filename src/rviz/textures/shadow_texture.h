// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// Paints the shadow of an upright body: white, with its strength in alpha; dark at the feet, which
/// are at the top, and soft at the head.
Image shadowPicture();
/// Paints a soft disc: white, with its strength (1 - r^2)^2 in alpha.
Image blobPicture();

}  // namespace vegetation_sim::view
