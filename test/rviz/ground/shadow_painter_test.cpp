// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/shadow_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr int EDGE = 128;

// A shadow that reaches over the border of the plot fades out before it, without a step.
TEST(ShadowPainter, AnOverlayHasNoEdge) {
  const Image overlay = overlayPicture(std::vector<float>(EDGE * EDGE, 0.f), EDGE, wholePlot(EDGE));
  float largest = 0.f;
  for (int i = 0; i < EDGE; ++i) {
    for (const auto& [column, row] : {std::pair{i, 0}, {i, EDGE - 1}, {0, i}, {EDGE - 1, i}})
      largest = std::max(largest, overlay.at(column, row)[3]);
  }
  EXPECT_LT(largest, 0.01f);
  EXPECT_GT(overlay.at(EDGE / 2, EDGE / 2)[3], 0.5f);
  EXPECT_EQ(overlay.at(EDGE / 2, EDGE / 2)[3], overlay.at(EDGE / 4, EDGE / 4)[3]);
  float step = 0.f;
  for (int i = 1; i < EDGE; ++i)
    step = std::max(step, std::fabs(overlay.at(i, EDGE / 2)[3] - overlay.at(i - 1, EDGE / 2)[3]));
  EXPECT_LT(step, 0.1f);
}

// A part of the overlay that is painted anew fits the rest.
TEST(ShadowPainter, AWindowIsAPartOfTheOverlay) {
  std::vector<float> light;
  for (int i = 0; i < EDGE * EDGE; ++i) light.push_back(0.01f * static_cast<float>(i % 97));
  const Image whole = overlayPicture(light, EDGE, wholePlot(EDGE));
  const Window window{0, 32, 64, 96};
  const Image part = overlayPicture(light, EDGE, window);
  for (int r = 0; r < window.rows; ++r)
    for (int c = 0; c < window.columns; ++c)
      EXPECT_EQ(part.at(c, window.rows - 1 - r),
                whole.at(window.column + c, EDGE - 1 - window.row - r));
}

}  // namespace
}  // namespace vegetation_sim::view
