// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/plants/leaf.h"

namespace vegetation_sim::canopy {

/// Images of slices through a plant, the nearest first (S3-29): samples row after row from the top,
/// slice after slice.
struct SliceStack {
  int columns{0}, rows{0}, slices{0};
  std::vector<double> density;  ///< 0 to 1
};

/// Makes a leaf for each cell of density `solid` or more that is not covered on all sides. The rows
/// give the height; the depth of all slices equals their width. @throws InvalidInput with all
/// faults: sizes that do not fit, densities out of range, no solid cell, too many.
Form formOf(const SliceStack& stack, double solid);

}  // namespace vegetation_sim::canopy
