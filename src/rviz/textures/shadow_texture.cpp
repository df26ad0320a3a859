// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/shadow_texture.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr int COLUMNS = 32, ROWS = 64;
constexpr int BLOB_EDGE = 64;

// Returns half the width of a body as a share of the image at v from its feet (0) to its head (1).
double halfWidth(double v) {
  return v < 0.8 ? 0.42 + 0.35 * std::sin(PI * v) : 0.42;
}

}  // namespace

Image shadowPicture() {
  Image out(COLUMNS, ROWS, {1.f, 1.f, 1.f, 0.f});
  for (int r = 0; r < ROWS; ++r) {
    const double v = (r + 0.5) / ROWS, soft = 0.25 + 0.45 * v;
    const double along = smoothStep(v / 0.12) * smoothStep((1.0 - v) / 0.25);
    for (int c = 0; c < COLUMNS; ++c) {
      const double x = std::fabs(2.0 * (c + 0.5) / COLUMNS - 1.0);
      const double inside =
          smoothStep((halfWidth(v) + soft - x) / (2.0 * soft)) * smoothStep((1.0 - x) / 0.2);
      out.at(c, r)[3] = static_cast<float>(inside * along * (1.0 - 0.45 * v));
    }
  }
  return out;
}

Image blobPicture() {
  Image out(BLOB_EDGE, BLOB_EDGE, {1.f, 1.f, 1.f, 0.f});
  for (int r = 0; r < BLOB_EDGE; ++r) {
    for (int c = 0; c < BLOB_EDGE; ++c) {
      const double x = 2.0 * (c + 0.5) / BLOB_EDGE - 1.0, y = 2.0 * (r + 0.5) / BLOB_EDGE - 1.0;
      const double inside = std::max(0.0, 1.0 - x * x - y * y);
      out.at(c, r)[3] = static_cast<float>(inside * inside * (3.0 - 2.0 * inside));
    }
  }
  return out;
}

}  // namespace vegetation_sim::view
