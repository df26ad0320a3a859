// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/strip_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace vegetation_sim::view {
namespace {

constexpr double FULL = 800.0;  // [1/m^2]

class StripCoverTest : public testing::Test {
 protected:
  StripCoverTest() : map_(input()), tile_(makeTile(map_, flat_, 7, 2, 2)) {}

  static grass::MapInput input() {
    grass::MapInput out;
    out.law.columns = out.law.rows = 6;
    out.density.value = FULL;
    out.height.value = 0.4;
    return out;
  }
  void append() { appendStrips(map_, tile_, {}, 1.0, FULL, mesh_); }
  // Returns the place of a vertex in sides of the tile, from its south-west corner.
  grass::Point placeOf(std::size_t vertex) const {
    const double size = double{tile_.size};
    return {(double{mesh_.positions[3 * vertex]} - tile_.x) / size,
            (double{mesh_.positions[3 * vertex + 1]} - tile_.y) / size};
  }
  double heightOf(std::size_t vertex) const { return double{mesh_.positions[3 * vertex + 2]}; }

  terrain::HeightMap flat_;
  grass::FeatureMap map_;
  grass::Tile tile_;
  grass::GrassMesh mesh_;
};

// S2-10, S2-12: the four strips of a tile vary, but stand on its edges, where blades slide to.
TEST_F(StripCoverTest, StripsStandOnTheEdges) {
  const StripsBegin begin(mesh_);
  append();
  varyStrips(tile_, begin, mesh_);
  constexpr std::size_t LINE = 2 * (grass::STRIP_CELLS + 1);
  ASSERT_EQ(mesh_.vertexCount(), 4 * LINE);
  for (std::size_t i = 0; i < mesh_.vertexCount(); i += 2) {
    const grass::Point at = placeOf(i);
    const std::array<double, 4> inward{at.y, 1.0 - at.x, 1.0 - at.y, at.x};
    EXPECT_NEAR(*std::min_element(inward.begin(), inward.end()), 0.0, 1e-4);
  }
}

// S2-11: a share of the strips is left, and triangles that would show nothing are gone.
TEST_F(StripCoverTest, ThinStripsKeepTheirShare) {
  double kept = 0.0, full = 0.0;
  std::size_t triangles = 0;
  for (int column = 0; column < 5; ++column)
    for (int row = 0; row < 5; ++row) {
      tile_ = makeTile(map_, flat_, 7, column, row);
      const StripsBegin begin(mesh_);
      append();
      triangles += (mesh_.indices.size() - begin.index) / 3;
      for (std::size_t i = begin.vertex; i < mesh_.vertexCount(); ++i)
        full += mesh_.colours[4 * i + 3];
      thinStrips(tile_, begin, 0.4, mesh_);
      for (std::size_t i = begin.vertex; i < mesh_.vertexCount(); ++i)
        kept += mesh_.colours[4 * i + 3];
    }
  EXPECT_NEAR(kept / full, 0.4, 0.08);
  EXPECT_LT(mesh_.indices.size() / 3, triangles * 9 / 10);
}

TEST_F(StripCoverTest, TopsOfVariedStripsLeanToBothSides) {
  const StripsBegin begin(mesh_);
  append();
  varyStrips(tile_, begin, mesh_);
  int left = 0, right = 0;
  for (std::size_t i = 0; i < mesh_.vertexCount(); i += 2) {
    EXPECT_NEAR(heightOf(i + 1), 0.4, 0.11);
    EXPECT_EQ(heightOf(i), 0.0);
    (placeOf(i + 1).x < placeOf(i).x ? left : right)++;
  }
  EXPECT_GT(left, 4);
  EXPECT_GT(right, 4);
}

}  // namespace
}  // namespace vegetation_sim::view
