// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/opacity_mask.h"

#include <algorithm>

#include "terrain/image_formats.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::terrain {
namespace {

// Returns the number of the pixel at a share of an edge; 0 if the share is not a number.
int pixelAt(double share, int pixels) {
  const double at = share * pixels;
  return at > 0.0 ? static_cast<int>(std::min(at, pixels - 1.0)) : 0;
}

}  // namespace

bool OpacityMask::isOpaqueAt(double u, double v) const {
  if (empty()) return true;
  const int column = pixelAt(u, columns), row = pixelAt(1.0 - v, rows);
  return opaque[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
}

OpacityMask parseOpacityMask(const std::string& bytes) {
  if (!looksLikePng(bytes)) throw InvalidInput("is no PNG");
  return parsePngOpacity(bytes);
}

}  // namespace vegetation_sim::terrain
