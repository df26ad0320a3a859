// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// Shadow of an upright body: white, alpha is how much of it there is; dark at its feet, which are
/// on top, and soft at its head.
Image shadowPicture();

}  // namespace vegetation_sim::view
