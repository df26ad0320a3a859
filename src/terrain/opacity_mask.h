// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vegetation_sim::terrain {

/// Longest side of a picture whose mask is read [pixel]: decoding takes up to 64 MiB for a moment,
/// a mask keeps up to 2 MiB.
constexpr int LONGEST_MASK_SIDE = 4096;

/// Where a picture is opaque: its pixels with an alpha of at least one half.
struct OpacityMask {
  int columns{0}, rows{0};   ///< both 0: the picture is opaque everywhere
  std::vector<bool> opaque;  ///< [rows x columns], top row first, left to right

  bool empty() const { return opaque.empty(); }
  /// Returns whether the pixel at a place is opaque. @param u across and @param v up from the lower
  /// left corner, 0 to 1; places beyond count as those on the edge.
  bool isOpaqueAt(double u, double v) const;
};

/// Reads the mask of a PNG of any colour type; one without alpha has an empty mask.
/// @param bytes of the file. @throws InvalidInput that shows nothing of the contents.
OpacityMask parseOpacityMask(const std::string& bytes);

}  // namespace vegetation_sim::terrain
