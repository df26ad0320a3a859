// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "terrain/opacity_mask.h"
#include "vegetation_sim/terrain/grey_image.h"

namespace vegetation_sim::terrain {

/// Returns whether the bytes start as a PNG does.
bool looksLikePng(const std::string& bytes);
/// Returns whether the bytes start as a PGM does.
bool looksLikePgm(const std::string& bytes);

/// @throws InvalidInput
GreyImage parsePng(const std::string& bytes, const std::string& name);
/// @throws InvalidInput
GreyImage parsePgm(const std::string& bytes, const std::string& name);

/// See parseOpacityMask(). @throws InvalidInput
OpacityMask parsePngOpacity(const std::string& bytes);

}  // namespace vegetation_sim::terrain
