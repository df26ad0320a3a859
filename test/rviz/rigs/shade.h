// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tree/mesh/light_grid.h"

namespace vegetation_sim {

/// Returns the light below a roof of leaves over all plants, which the sun hardly shines through.
inline std::shared_ptr<const forest::LightGrid> lightBelowARoof() {
  auto out = std::make_shared<forest::LightGrid>(Vec3(-8, -8, 0), Vec3(8, 8, 8), 0.5);
  for (int i = 0; i < 6400; ++i)
    out->addLeaf(Vec3(-8.0 + 0.2 * (i % 80), -8.0 + 0.2 * (i / 80), 6.0), 0.2);
  out->cast(Vec3(0.0, 0.0, 1.0));
  return out;
}

/// Returns the mean green of the pixels that are not of the background.
inline double brightnessOfPlants(const std::vector<std::uint8_t>& pixels) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
    if (pixels[i + 2] > 150) continue;
    sum += pixels[i + 1];
    count += 1.0;
  }
  return sum / count;
}

}  // namespace vegetation_sim
