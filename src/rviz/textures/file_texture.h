// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// Largest edge of a picture in a file [pixel].
constexpr int LARGEST_PICTURE = 8192;

/// Reads a picture in a file of any format that Qt reads, and scales it to a square.
/// @param bytes of the file. @param edge of the square [pixel]. @throws InvalidInput.
Image readPicture(const std::string& bytes, int edge);

}  // namespace vegetation_sim::view
