// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim {

/// Lowest and highest stage of growth: a seedling, and the grown plant.
constexpr double SEEDLING = 0.0, GROWN = 1.0;

/// Sizes of a plant at a stage of growth over those of the grown plant. All are 1 for the grown
/// plant and rise with the stage.
struct GrowthFactors {
  double height{1.0};     ///< 0.05 + 0.95 stage
  double thickness{1.0};  ///< height^(3/2): stems of equal elastic stability (McMahon 1973)
  double count{1.0};      ///< 0.2 + 0.8 stage, of limbs and leaves
  double leaf{1.0};       ///< height^(1/2), of the edges of leaves
};

/// Returns the factors for a stage from SEEDLING to GROWN.
GrowthFactors growthFactors(double stage);

}  // namespace vegetation_sim
