// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/bark_texture.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

using forest::LeafShape;

constexpr float COLUMN_INSET =
    0.02f;  // share of a column that keeps its neighbours out of the filter

// Draws bright ridges along the wood between narrow dark fissures.
float fissures(const Noise& noise, float around, float along) {
  const float bend = 0.12f * noise.fractal(2.f * around, 3.f * along, 2);
  const float ridge = std::fabs(2.f * noise.fractal(9.f * (around + bend), 1.5f * along, 3) - 1.f);
  return 0.52f + 0.5f * std::min(1.f, 2.6f * ridge) -
         0.1f * noise.smooth(20.f * around, 30.f * along);
}

// Draws flat plates with dark gaps.
float plates(const Noise& noise, float around, float along) {
  const float a = std::fabs(2.f * noise.fractal(4.f * around, 7.f * along, 2) - 1.f);
  const float b = std::fabs(2.f * noise.fractal(6.f * around + 20.f, 5.f * along + 9.f, 2) - 1.f);
  return 0.55f + 0.45f * std::min(1.f, 3.f * std::min(a, b)) -
         0.1f * noise.smooth(17.f * around, 23.f * along);
}

float paleBark(const Noise& noise, float around, float along) {
  return 0.9f + 0.1f * noise.fractal(3.f * around, 12.f * along, 3);
}

// Draws dark strokes across the wood and a few rough patches.
void addLenticels(Image& picture) {
  const Random random(0xb12c);
  for (std::uint64_t i = 0; i < 150; ++i) {
    const Random own = random.child(i);
    const bool patch = i % 12 == 0;
    const double x = own.uniform(0), y = own.uniform(1);
    const double half_width = patch ? own.uniform(2, 0.1, 0.22) : own.uniform(2, 0.03, 0.13);
    const double half_height = patch ? own.uniform(3, 0.008, 0.02) : own.uniform(3, 0.0015, 0.004);
    const auto dark = static_cast<float>(own.uniform(4, 0.12, 0.4));
    for (int r = 0; r < picture.rows; ++r) {
      const double v = (r / static_cast<double>(picture.rows) - y) / half_height;
      if (std::fabs(v) > 1.0) continue;
      for (int c = 0; c < picture.columns; ++c) {
        const double u = (c / static_cast<double>(picture.columns) - x) / half_width;
        if (u * u + v * v < 1.0) picture.blend(c, r, {dark, dark, dark, 0.85f});
      }
    }
  }
}

}  // namespace

Image barkPicture(forest::LeafShape shape, int columns) {
  const int rows = 4 * columns;
  const Noise noise(0xba2c + static_cast<std::uint64_t>(shape));
  Image out(columns, rows, {1.f, 1.f, 1.f, 1.f});
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      // The second half mirrors the first, so that the texture closes.
      const float around =
          1.f - std::fabs(2.f * static_cast<float>(c) / static_cast<float>(columns) - 1.f);
      const float along = 4.f * static_cast<float>(r) / static_cast<float>(rows);
      float value = 0.f;
      if (shape == LeafShape::SMALL)
        value = paleBark(noise, around, along);
      else if (shape == LeafShape::NEEDLE)
        value = plates(noise, around, along);
      else
        value = fissures(noise, around, along);
      value = std::clamp(value, 0.f, 1.f);
      out.at(c, r) = {value, value, value, 1.f};
    }
  }
  if (shape == LeafShape::SMALL) addLenticels(out);
  return out;
}

Image barkAtlas(int edge) {
  Image out(edge, 2 * edge, {});
  for (int shape = 0; shape < 4; ++shape)
    paste(barkPicture(static_cast<LeafShape>(shape), edge / 4), shape * edge / 4, 0, out);
  for (int r = 0; r < edge; ++r)
    for (int c = 0; c < edge; ++c) out.at(c, 2 * edge - 1 - r) = out.at(c, r);
  return out;
}

float barkAtlasU(LeafShape shape, float around) {
  return 0.25f * (static_cast<float>(shape) + COLUMN_INSET + (1.f - 2.f * COLUMN_INSET) * around);
}

}  // namespace vegetation_sim::view
