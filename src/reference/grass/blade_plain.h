// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "vegetation_sim/grass/blades/blade_batch.h"

namespace vegetation_sim::grass {

/// Poses one blade after the other, with the same bits as poseBlades().
void poseBladesPlain(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out);

/// Points of one blade [m], as in BladeBlock.
struct ReferenceBlade {
  std::array<double, POINTS> x{}, y{}, z{};
};
/// Poses one blade in double precision from the same random numbers: the reference for the error
/// of poseBlades().
ReferenceBlade poseReference(const Tile& tile, const TileMotion& motion, int blade);

/// The properties of a blade that do not depend on its motion.
struct BladeTraits {
  float u{0.f}, v{0.f};  ///< place of the root in the tile, 0 to 1
  float length{0.f};     ///< [m]
  int species{0};
  float colour{0.f};  ///< 0 is the species' colour, 1 its dry colour
};
BladeTraits traitsOf(const Tile& tile, int blade);

}  // namespace vegetation_sim::grass
