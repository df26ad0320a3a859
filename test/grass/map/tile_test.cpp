// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/tile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

MapInput rampMap() {
  MapInput input;
  input.law.columns = input.law.rows = 101;
  terrain::GreyImage ramp{101, 101, 100, {}};
  for (int row = 0; row < 101; ++row)
    for (int column = 0; column < 101; ++column)
      ramp.samples.push_back(static_cast<std::uint16_t>(column));
  input.density = {0.0, ramp, 0.0, 37.0};
  return input;
}

// S2-04: area times the mean of four densities, exact where that is whole.
TEST(Tile, HoldsAreaTimesTheMeanOfFourDensities) {
  for (const double chance : {0.0, 0.5, 0.999999}) {
    EXPECT_EQ(bladeCount({100.f, 200.f, 300.f, 400.f}, 2.f, chance), 1000);
    EXPECT_EQ(bladeCount({0.f, 0.f, 0.f, 8.f}, 2.f, chance), 8);
    EXPECT_EQ(bladeCount({0.f, 0.f, 0.f, 0.f}, 2.f, chance), 0);
  }
  EXPECT_EQ(bladeCount({1.f, 1.f, 1.f, 1.f}, 0.5f, 0.74), 0);
  EXPECT_EQ(bladeCount({1.f, 1.f, 1.f, 1.f}, 0.5f, 0.76), 1);
}

// S2-04: unbiased to 3 sigma over 10 000 tiles of fractional means.
TEST(Tile, CountIsUnbiased) {
  const FeatureMap map(rampMap());
  double counted = 0.0, expected = 0.0, variance = 0.0;
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 100; ++column) {
      const Tile tile = makeTile(map, terrain::HeightMap(), 9, column, row);
      const double mean =
          4.0 * map.at(2.0 * column + 1.0, 2.0 * row + 1.0).density;  // a tile is 4 m^2
      const double part = mean - std::floor(mean);
      counted += tile.blades;
      expected += mean;
      variance += part * (1.0 - part);
      ASSERT_LT(std::fabs(tile.blades - mean), 1.0);
    }
  EXPECT_GT(variance, 100.0);
  EXPECT_LT(std::fabs(counted - expected), 3.0 * std::sqrt(variance));
}

// S2-05: the seed of a tile is a function of the map's seed and its place only.
TEST(Tile, IsTheSameAfterLeavingAndComingBack) {
  const FeatureMap map(rampMap());
  const Tile before = makeTile(map, terrain::HeightMap(), 9, 17, 31);
  for (int i = 0; i < 50; ++i) makeTile(map, terrain::HeightMap(), 9, i, 2 * i);
  const Tile after = makeTile(map, terrain::HeightMap(), 9, 17, 31);
  EXPECT_EQ(before.key, after.key);
  EXPECT_EQ(before.blades, after.blades);
  EXPECT_NE(before.key, makeTile(map, terrain::HeightMap(), 9, 31, 17).key);
  EXPECT_NE(before.key, makeTile(map, terrain::HeightMap(), 8, 17, 31).key);
}

TEST(Tile, TakesItsGroundFromTheTerrain) {
  const terrain::HeightMap hill = slopedGround(0.2, 0.1);
  const Tile tile = makeTile(FeatureMap(), hill, 1, 3, 5);
  ASSERT_TRUE(tile.sloped);
  EXPECT_EQ(tile.ground_cells, 2);  // samples 1 m apart under a tile of 2 m
  EXPECT_EQ(tile.z, hill.height(6.0, 10.0));
  EXPECT_NEAR(tile.z + tile.ground[4], hill.height(7.0, 11.0), 1e-6);  // float, 1 m
  EXPECT_NEAR(tile.z + tile.ground[8], hill.height(8.0, 12.0), 1e-6);
}

}  // namespace
}  // namespace vegetation_sim::grass
