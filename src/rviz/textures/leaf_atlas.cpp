// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/leaf_atlas.h"

#include <algorithm>
#include <functional>

namespace vegetation_sim::view {
namespace {

using forest::LeafShape;

// Scales alpha so that the same fraction passes the alpha test as in the full image.
void keepCoverage(double wanted, Image& picture) {
  std::vector<float> alphas;
  for (const Rgba& pixel : picture.pixels) alphas.push_back(pixel[3]);
  std::sort(alphas.begin(), alphas.end(), std::greater<>());
  const auto rank = static_cast<std::size_t>(wanted * static_cast<double>(alphas.size()));
  const float limit = std::max(alphas[std::min(rank, alphas.size() - 1)], 1e-3f);
  for (Rgba& pixel : picture.pixels)
    pixel[3] = std::min(1.f, pixel[3] * (ALPHA_LIMIT + 1.f / 255.f) / limit);
}

}  // namespace

std::vector<Image> coveredMipmaps(const Image& picture, int smallest) {
  std::vector<Image> levels = mipmaps(picture, smallest);
  const double wanted = coverage(picture);
  for (std::size_t level = 1; level < levels.size(); ++level) keepCoverage(wanted, levels[level]);
  return levels;
}

std::vector<Image> leafAtlas(int edge) {
  std::vector<Image> out;
  for (int cell = 0; cell < 8; ++cell) {
    const auto shape = static_cast<LeafShape>(cell % 4);
    const std::vector<Image> levels = coveredMipmaps(leafPicture(shape, cell >= 4, edge), 4);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const int side = levels[level].columns;
      if (cell == 0) out.emplace_back(4 * side, 2 * side, Rgba{});
      paste(levels[level], side * (cell % 4), side * (cell / 4), out[level]);
    }
  }
  return out;
}

std::array<float, 2> leafAtlasPlace(LeafShape shape, bool bough, const std::array<float, 2>& at) {
  return {0.25f * (static_cast<float>(shape) + at[0]), 0.5f * ((bough ? 2.f : 1.f) - at[1])};
}

}  // namespace vegetation_sim::view
