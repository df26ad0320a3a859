// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/blade_shade.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double BLADE_REACH = 0.4;  // [m] of blades beyond their tile

}  // namespace

BladeShade::BladeShade(const grass::MapLaw& law, const std::vector<const BlobShadow*>& shadows) {
  const auto tileOf = [&](double way) {
    return static_cast<int>(std::floor(std::clamp(way / law.resolution, -1.0, 1e6)));
  };
  for (const BlobShadow* shadow : shadows) {
    const double x = shadow->centre.x() - law.origin_x, y = shadow->centre.y() - law.origin_y;
    const double dx = std::hypot(shadow->first.x(), shadow->second.x()) + BLADE_REACH;
    const double dy = std::hypot(shadow->first.y(), shadow->second.y()) + BLADE_REACH;
    const int right = std::min(law.columns, tileOf(x + dx)),
              top = std::min(law.rows, tileOf(y + dy));
    for (int row = std::max(0, tileOf(y - dy)); row <= top; ++row)
      for (int column = std::max(0, tileOf(x - dx)); column <= right; ++column)
        tiles_[{row, column}].push_back(shadow);
  }
}

void BladeShade::darken(int column, int row, std::size_t first, grass::GrassMesh& mesh) const {
  const auto found = tiles_.find({row, column});
  if (found == tiles_.end()) return;
  for (std::size_t i = first; i < mesh.vertexCount(); ++i) {
    const float* p = &mesh.positions[3 * i];
    const Vec3 place = mesh.origin + Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                          static_cast<double>(p[2]));
    double left = 1.0;
    for (const BlobShadow* shadow : found->second) left *= 1.0 - shadeAt(*shadow, place);
    if (left >= 1.0) continue;
    std::uint8_t* colour = &mesh.colours[4 * i];
    for (int k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(left * colour[k]);
  }
}

}  // namespace vegetation_sim::view
