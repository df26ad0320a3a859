// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <vector>

#include "canopy/plants/stubble.h"
#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim {

/// A map of the feet of plants for planners (N5).
class CanopyCover {
 public:
  /// @param resolution edge of a cell [m], doubled until there are at most 4 000 000 cells.
  CanopyCover(const canopy::Layout& layout, double resolution);

  /// Returns the share of the plants in each cell that are cut [percent]; -1: no plant but
  /// trellises. Left to the caller: the header. Empty if the layout has no plants.
  nav_msgs::OccupancyGrid cutShare(const canopy::Stubble& stubble) const;

 private:
  nav_msgs::MapMetaData info_;
  std::vector<int> cells_;   ///< of each plant; -1: a trellis
  std::vector<int> plants_;  ///< number in each cell
};

}  // namespace vegetation_sim
