// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "grass/blades/blade_placement.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = 500;  // tiles of 2 m along the edge of a square kilometre
constexpr int SAMPLES = 400;

/// Blades that are generated in tiles chosen at random.
struct Sampled {
  double blades{0.0}, expected{0.0};
  double least{1e9}, most{0.0};  ///< blades of a tile per expected one
  double east{0.0};              ///< blades in the eastern halves of tiles
};

// Poses every blade of the sampled tiles, as a display does. Places are relative to the tile.
Sampled generateSamples(const FeatureMap& map) {
  Sampled out;
  const Random random(17);
  for (std::uint64_t i = 0; i < SAMPLES; ++i) {
    const auto column = static_cast<int>(random.uniform(2 * i, 0.0, SIDE));
    const auto row = static_cast<int>(random.uniform(2 * i + 1, 0.0, SIDE));
    const Tile tile = makeTile(map, terrain::HeightMap(), 3, column, row);
    const auto blocks = posed(tile, TileMotion(), tile.blades);
    for (int blade = 0; blade < tile.blades; ++blade) {
      const Vec3 root = pointOf(blocks, blade, 0), tip = pointOf(blocks, blade, LINKS);
      const double u = root.x() / double{tile.size}, v = root.y() / double{tile.size};
      EXPECT_TRUE(u >= -1e-5 && u <= 1.0 + 1e-5 && v >= -1e-5 && v <= 1.0 + 1e-5) << u << ' ' << v;
      EXPECT_TRUE(tip.z() >= 0.0 && (tip - root).norm() <= map.tallest() * (1.0 + 1e-5)) << tip.z();
      out.east += u > 0.5;
    }
    double density = 0.0;
    for (const float corner : tile.density) density += 0.25 * double{corner};
    const double expected = density * double{tile.size} * double{tile.size};
    out.blades += tile.blades;
    out.expected += expected;
    out.least = std::min(out.least, tile.blades / expected);
    out.most = std::max(out.most, tile.blades / expected);
  }
  return out;
}

MapInput squareKilometre() {
  MapInput input;
  input.law.resolution = 2.0;
  input.law.columns = input.law.rows = SIDE + 1;
  input.density.value = 1000.0;
  return input;
}

// S2-01: a square kilometre holds a billion blades; each tile generates its own.
TEST(SquareKilometre, GeneratesABillionBlades) {
  const FeatureMap map(squareKilometre());
  ASSERT_EQ(map.tileColumns() * map.tileRows(), SIDE * SIDE);
  const Sampled found = generateSamples(map);
  const double all = found.blades / SAMPLES * SIDE * SIDE;
  EXPECT_NEAR(all, 1e9, 1e5);  // a tile of 4000 is off by at most one blade
  EXPECT_NEAR(found.least, 1.0, 1.0 / 4000.0);
  EXPECT_NEAR(found.most, 1.0, 1.0 / 4000.0);
  // Uniform places: five standard deviations.
  EXPECT_NEAR(found.east / found.blades, 0.5, 5.0 * 0.5 / std::sqrt(found.blades));
}

// S2-01: the count follows the map where the density changes from 0 to 2000 blades/m^2.
TEST(SquareKilometre, FollowsTheDensityOfItsMap) {
  MapInput input = squareKilometre();
  input.density = {0.0, {SIDE + 1, SIDE + 1, SIDE, {}}, 0.0, 2000.0};
  for (int i = 0; i < (SIDE + 1) * (SIDE + 1); ++i)
    input.density.image.samples.push_back(static_cast<std::uint16_t>(i % (SIDE + 1)));
  const FeatureMap map(input);
  const Sampled found = generateSamples(map);
  EXPECT_NEAR(found.blades / found.expected, 1.0, 1e-3);
  // The mean of a ramp over uniform samples has a standard deviation of 0.58 of itself.
  EXPECT_NEAR(found.blades / SAMPLES * SIDE * SIDE, 1e9, 5.0 * 0.58e9 / std::sqrt(SAMPLES));
}

}  // namespace
}  // namespace vegetation_sim::grass
