// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/foliage_texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr int EDGE = 128;

/// Returns the share of drawn pixels of an image of the atlas between two distances from its
/// middle, relative to half its edge.
double coverOf(const Image& atlas, LeafCut cut, double from, double to) {
  const std::array<float, 2> corner = foliagePlace(cut, 0.f, 0.f),
                             end = foliagePlace(cut, 1.f, 1.f);
  int all = 0, drawn = 0;
  for (int row = 0; row < atlas.rows; ++row)
    for (int column = 0; column < atlas.columns; ++column) {
      const double u = ((column + 0.5) / atlas.columns - double{corner[0]}) /
                       (double{end[0]} - double{corner[0]});
      const double v =
          ((row + 0.5) / atlas.rows - double{corner[1]}) / (double{end[1]} - double{corner[1]});
      const double out = 2.0 * std::hypot(u - 0.5, v - 0.5);
      if (u < 0.0 || u > 1.0 || out < from || out >= to) continue;
      ++all;
      drawn += atlas.at(column, row)[3] > 0.5f;
    }
  return static_cast<double>(drawn) / all;
}

// S3-W6: a puff of a cloud is dense in its middle, thin at its edge and empty beyond; a leaf has a
// firm outline.
TEST(FoliageTexture, PuffsAreThinAtTheirEdges) {
  const Image atlas = foliageAtlas(EDGE).front();
  const double middle = coverOf(atlas, LeafCut::PUFF, 0.0, 0.3);
  const double edge = coverOf(atlas, LeafCut::PUFF, 0.55, 0.8);
  EXPECT_GT(middle, 0.55);
  EXPECT_LT(edge, 0.5 * middle);
  EXPECT_GT(edge, 0.03);
  EXPECT_LT(coverOf(atlas, LeafCut::PUFF, 1.02, 1.5), 0.01);
  EXPECT_GT(coverOf(atlas, LeafCut::LEAF, 0.0, 0.3), 0.95);
}

}  // namespace
}  // namespace vegetation_sim::view
