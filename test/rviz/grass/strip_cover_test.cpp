// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/strip_cover.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double FULL = 800.0;  // [1/m^2]
constexpr int CELLS = 20;       // of the trodden ground

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
  void append() { appendShiftedStrips(map_, flat_, tile_, motion_, 1.0, FULL, {}, mesh_); }
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
  grass::TileMotion motion_;
  grass::GrassMesh mesh_;
};

// S2-10: there are four strips, and few of their points are near the straight lines of the grid.
TEST_F(StripCoverTest, StripsAreShiftedFromTheEdges) {
  append();
  constexpr std::size_t LINE = 2 * (grass::STRIP_CELLS + 1);
  ASSERT_EQ(mesh_.vertexCount(), 4 * LINE);
  int near = 0;
  for (std::size_t i = 0; i < mesh_.vertexCount(); i += 2) {
    const grass::Point at = placeOf(i);
    const std::array<double, 4> inward{at.y, 1.0 - at.x, 1.0 - at.y, at.x};
    near += std::fabs(inward[i / LINE]) < 0.03;
    EXPECT_GT(inward[i / LINE], -0.2);
    EXPECT_LT(inward[i / LINE], 0.5);
    EXPECT_NEAR(heightOf(i + 1), 0.4, 1e-3);
  }
  EXPECT_LT(near, 5);
}

// S2-21: a strip is as the ground is where it stands, not at its edge.
TEST_F(StripCoverTest, StripsLieAndAreCutWhereTheyStand) {
  grass::CrushPatch crush;
  crush.cells = CELLS;
  constexpr std::size_t NODES = (CELLS + 1) * (CELLS + 1);
  crush.tilt.assign(NODES, 0.f);
  crush.tx = crush.ty = crush.swath = crush.tilt;
  crush.cut.assign(NODES, 1e9f);
  for (std::size_t node = 0; node < NODES; ++node) {
    if (node / (CELLS + 1) > CELLS / 2) {
      crush.cut[node] = 0.1f;
    } else if (node % (CELLS + 1) > CELLS / 2) {
      crush.tilt[node] = crush.tx[node] = 1.5f;
    }
  }
  motion_.crush = &crush;
  append();
  int cut = 0, lying = 0;
  for (std::size_t i = 0; i < mesh_.vertexCount(); i += 2) {
    const grass::Point at = placeOf(i);
    if (at.y > 0.55) {
      ++cut;
      EXPECT_NEAR(heightOf(i + 1), 0.1, 1e-3);
      EXPECT_LT(mesh_.colours[4 * i + 3], 80);
    } else if (at.y < 0.45 && at.x > 0.55) {
      ++lying;
      EXPECT_LT(heightOf(i + 1), 0.05);
    } else if (at.y < 0.45 && at.x < 0.45) {
      EXPECT_NEAR(heightOf(i + 1), 0.4, 1e-3);
    }
  }
  EXPECT_GT(cut, 0);
  EXPECT_GT(lying, 0);
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

TEST_F(StripCoverTest, TopsOfRuffledStripsLeanToBothSides) {
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
