// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "rviz/ground/blob_shadow.h"
#include "vegetation_sim/grass/map/feature_map.h"

namespace vegetation_sim::view {

/// Shadows on the grass, by the tiles that they touch.
class BladeShade {
 public:
  BladeShade(const grass::MapLaw& law, const std::vector<const BlobShadow*>& shadows);

  /// Darkens the vertices of a tile. @param first its first vertex; those after it are the tile's.
  void darken(int column, int row, std::size_t first, grass::GrassMesh& mesh) const;

 private:
  std::map<std::pair<int, int>, std::vector<const BlobShadow*>> tiles_;  // by row and column
};

}  // namespace vegetation_sim::view
