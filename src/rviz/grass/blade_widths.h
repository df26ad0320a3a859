// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grass/lod/meadow_lod.h"

namespace vegetation_sim::view {

/// How many times as wide a blade is drawn at most where strips stand among blades.
constexpr double WIDEST_BLADE = 1.4;

/// How the blades of a tile are drawn, and what they leave uncovered.
struct BladeWidths {
  double own{1.0};      ///< factor on the width of the blades themselves
  double beside{0.0};   ///< likewise of their siblings; 0: there are none
  double kept{1.0};     ///< share of the blades of this level of detail that are drawn
  double missing{0.0};  ///< share of the grass that these blades do not cover
  double leaving{0.0};  ///< share of the blades that narrow because fewer are drawn soon
};

/// Returns the widths of the blades of a tile at a horizontal distance [m]. Few blades would have
/// to be broad to cover as much as all do. With `strips`, no blade is wider than WIDEST_BLADE in a
/// view from the side, and the rest is missing.
BladeWidths widthsOf(const grass::TileView& tile, double distance, bool strips);

}  // namespace vegetation_sim::view
