// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/blades/blade_batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "reference/grass/blade_plain.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

bool sameBits(const std::vector<BladeBlock>& a, const std::vector<BladeBlock>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(BladeBlock)) == 0;
}

// Every path through the kernels: level and sloped, untrodden and trodden, one species and three,
// calm and storm, both models.
struct Scene {
  Tile tile;
  TileMotion motion;
};

std::vector<Scene> scenes(const CrushPatch& patch) {
  MapInput mixed;
  mixed.species.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    Species& s = mixed.species[i].species;
    s.name += std::to_string(i);
    s.height = 0.6 + 0.3 * static_cast<double>(i);
    s.compliance = 0.03 * static_cast<double>(i + 1);
  }
  mixed.species[1].mix = {0.0, {2, 2, 1, {0, 1, 1, 0}}, 0.0, 2.0};
  const FeatureMap maps[] = {FeatureMap(), FeatureMap(mixed)};
  const terrain::HeightMap grounds[] = {terrain::HeightMap(), slopedGround(0.3, -0.1)};
  std::vector<Scene> out;
  for (const FeatureMap& map : maps)
    for (const terrain::HeightMap& ground : grounds)
      for (const CrushPatch* crush : {static_cast<const CrushPatch*>(nullptr), &patch})
        for (const float wind : {0.f, 4.f, 40.f})
          for (const BladeModel model : {BladeModel::ARC, BladeModel::PAPER}) {
            Scene scene{makeTile(map, ground, 3, 0, 0), {}};
            scene.tile.density = {100.f, 0.f, 900.f, 300.f};
            scene.tile.shape = {0.f, 1.f, 0.5f, 0.2f};
            scene.motion.wind_x = {wind, 0.5f * wind, -wind, 0.f};
            scene.motion.wind_y = {0.f, wind, 0.3f * wind, 0.f};
            scene.motion.crush = crush;
            scene.motion.model = model;
            out.push_back(std::move(scene));
          }
  return out;
}

constexpr int COUNT = 1000;  // no multiple of a vector

// S2-05: one blade is the same blade on every processor.
TEST(BladeBatch, GivesTheSameBitsOnEveryInstructionSetAndAsThePlainVersion) {
  const CrushPatch patch = rampPatch(1.5f, 0.6f, -0.8f);
  ASSERT_GE(instructionSets().size(), 2u);
  for (const Scene& scene : scenes(patch)) {
    const auto plain = posedPlain(scene.tile, scene.motion, COUNT);
    for (const std::string& set : instructionSets()) {
      forceInstructionSet(set);
      const auto cached = posed(scene.tile, scene.motion, COUNT);
      const auto streamed = posed(scene.tile, scene.motion, COUNT, Store::STREAMED);
      forceInstructionSet("");
      EXPECT_TRUE(sameBits(plain, cached)) << set;
      EXPECT_TRUE(sameBits(plain, streamed)) << set;
    }
  }
}

// Error of single precision: 2e-6 of a tile of 2 m, some twenty roundings; a crushed blade's
// direction may be that of a field that is nearly zero.
TEST(BladeBatch, AgreesWithTheReferenceInDoublePrecision) {
  const CrushPatch patch = rampPatch(1.5f, 0.6f, -0.8f);
  double worst = 0.0;
  for (const Scene& scene : scenes(patch)) {
    const auto fast = posed(scene.tile, scene.motion, COUNT);
    for (int blade = 0; blade < COUNT; ++blade) {
      const ReferenceBlade exact = poseReference(scene.tile, scene.motion, blade);
      for (int i = 0; i < POINTS; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 error = pointOf(fast, blade, i) - Vec3(exact.x[k], exact.y[k], exact.z[k]);
        worst = std::max(worst, length(error));
      }
    }
  }
  EXPECT_LT(worst, 2e-5);  // [m]
}

// S2-05: levels of detail draw the first blades of a tile; those do not depend on how many follow.
TEST(BladeBatch, FewerBladesAreAPartOfMore) {
  const Tile tile = tileOf({500.f, 200.f, 100.f, 900.f});
  const auto all = posed(tile, TileMotion(), 1600);
  for (const int count : {1, 16, 17, 160, 1599}) {
    const auto few = posed(tile, TileMotion(), count);
    for (int blade = 0; blade < count; ++blade)
      for (int i = 0; i < POINTS; ++i)
        ASSERT_EQ(pointOf(few, blade, i), pointOf(all, blade, i)) << count;
  }
}

// S2-05: the same blades whichever thread makes them, beside whatever others.
TEST(BladeBatch, DoesNotDependOnThreads) {
  std::vector<Tile> tiles;
  for (int i = 0; i < 24; ++i) tiles.push_back(tileOf({500.f, 200.f, 100.f, 900.f}, i, 7));
  const auto make = [&](int threads) {
    std::vector<std::vector<BladeBlock>> out(tiles.size());
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        for (std::size_t i = static_cast<std::size_t>(t); i < tiles.size();
             i += static_cast<std::size_t>(threads))
          out[i] = posed(tiles[i], TileMotion(), COUNT);
      });
    for (std::thread& thread : pool) thread.join();
    return out;
  };
  const auto one = make(1), four = make(4);
  for (std::size_t i = 0; i < tiles.size(); ++i) EXPECT_TRUE(sameBits(one[i], four[i]));
}

// ---- density ---------------------------------------------------------------------------------

constexpr int BINS = 16;
constexpr int SAMPLES = 1000000;

double chiSquare(const Tile& tile, bool first_half_only) {
  std::vector<double> counts(BINS * BINS, 0.0);
  const int count = first_half_only ? SAMPLES / 8 : SAMPLES;
  for (int i = 0; i < count; ++i) {
    const BladeTraits look = traitsOf(tile, i);
    const int column = static_cast<int>(look.u * BINS), row = static_cast<int>(look.v * BINS);
    counts[static_cast<std::size_t>(row * BINS + column)] += 1.0;
  }
  const Corners& d = tile.density;
  const double mean = (double{d[0]} + d[1] + d[2] + d[3]) / 4.0;
  double sum = 0.0;
  for (int row = 0; row < BINS; ++row)
    for (int column = 0; column < BINS; ++column) {
      // The mean of a bilinear function over a bin is its value in the middle.
      const double u = (column + 0.5) / BINS, v = (row + 0.5) / BINS;
      const double density =
          (d[0] * (1 - u) + d[1] * u) * (1 - v) + (d[2] * (1 - u) + d[3] * u) * v;
      const double expected = count * density / mean / (BINS * BINS);
      const double off = counts[static_cast<std::size_t>(row * BINS + column)] - expected;
      sum += off * off / expected;
    }
  return sum;
}

class BladeDensity : public testing::TestWithParam<Corners> {};

// S2-06: positions follow the bilinear density (chi-square, 255 degrees of freedom); so do the
// first of them (S2-05).
TEST_P(BladeDensity, IsBilinear) {
  const Tile tile = tileOf(GetParam(), 11, 23);
  for (const bool part : {false, true}) {
    const double p = chiSquareTail(chiSquare(tile, part), BINS * BINS - 1);
    EXPECT_GT(p, 1e-4) << part;
    EXPECT_LT(p, 1.0 - 1e-4) << part;
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, BladeDensity,
                         testing::Values(Corners{1.f, 1.f, 1.f, 1.f},
                                         Corners{1.f, 1.00001f, 1.f, 1.00002f},  // nearly constant
                                         Corners{0.f, 0.f, 0.f, 1000.f},         // one corner
                                         Corners{0.f, 500.f, 0.f, 500.f},        // an empty edge
                                         Corners{900.f, 100.f, 50.f, 700.f},
                                         Corners{1000.f, 0.f, 0.f, 1000.f},  // opposite corners
                                         Corners{20000.f, 1.f, 3.f, 0.1f}));

// S2-06: no step at the border of two tiles: both have as many blades along it.
TEST(BladeBatch, DensityIsContinuousAcrossTheBorderOfTwoTiles) {
  const Tile west = tileOf({100.f, 400.f, 300.f, 800.f}, 0, 0);
  const Tile east = tileOf({400.f, 50.f, 800.f, 100.f}, 1, 0);
  double density[2] = {0.0, 0.0};
  constexpr float BAND = 0.02f;
  const int counts[] = {west.blades, east.blades};
  for (int seed = 0; seed < 400; ++seed) {
    Tile tiles[] = {west, east};
    for (int side = 0; side < 2; ++side) {
      tiles[side].key = Random(static_cast<std::uint64_t>(seed)).child(side).key();
      for (int i = 0; i < counts[side]; ++i) {
        const float u = traitsOf(tiles[side], i).u;
        if (side == 0 ? u > 1.f - BAND : u < BAND) density[side] += 1.0;
      }
    }
  }
  // Some 19 000 blades in each band; 4 sigma of their difference, and the slope within the band.
  EXPECT_NEAR(density[0] / density[1], 1.0, 4.0 * std::sqrt(2.0 / density[0]) + 0.01);
}

// S2-05: neighbouring tiles have nothing to do with each other.
TEST(BladeBatch, NeighbouringTilesAreUncorrelated) {
  const Tile a = tileOf({1.f, 1.f, 1.f, 1.f}, 4, 4), b = tileOf({1.f, 1.f, 1.f, 1.f}, 5, 4);
  constexpr int N = 100000;
  double sum = 0.0;
  for (int i = 0; i < N; ++i) sum += (traitsOf(a, i).u - 0.5) * (traitsOf(b, i).u - 0.5) * 12.0;
  EXPECT_LT(std::fabs(sum / N), 4.0 / std::sqrt(N));
}

// S2-W2: species come in the shares of the map, which vary over a tile; a share of nothing is none.
TEST(BladeBatch, SpeciesComeInTheirShares) {
  MapInput input;
  input.species.resize(3);
  for (std::size_t i = 0; i < 3; ++i) input.species[i].species.name += std::to_string(i);
  input.species[0].mix.value = 3.0;
  input.species[1].mix.value = 0.0;
  input.species[2].mix = {0.0, {2, 2, 1, {0, 1, 0, 1}}, 0.0, 3.0};
  const Tile tile = makeTile(FeatureMap(input), terrain::HeightMap(), 1, 0, 0);
  constexpr int N = 200000;
  double east[3] = {}, west[3] = {};
  for (int i = 0; i < N; ++i) {
    const BladeTraits look = traitsOf(tile, i);
    (look.u > 0.5f ? east : west)[look.species] += 1.0;
  }
  EXPECT_EQ(east[1] + west[1], 0.0);
  // Mean of u / (1 + u) over each half.
  const double west_share = 1.0 - 2.0 * std::log(1.5), east_share = 1.0 - 2.0 * std::log(4.0 / 3.0);
  const double bound = 4.0 * 0.5 / std::sqrt(N / 2.0);
  EXPECT_NEAR(west[2] / (west[0] + west[2]), west_share, bound);
  EXPECT_NEAR(east[2] / (east[0] + east[2]), east_share, bound);
}

// ---- shape -----------------------------------------------------------------------------------

// S2-09, E14: blades keep their length in any wind, trodden or not, on any slope.
TEST(BladeBatch, BladesKeepTheirLength) {
  const CrushPatch patch = rampPatch(1.5f, 0.6f, -0.8f);
  for (const Scene& scene : scenes(patch)) {
    if (scene.motion.model == BladeModel::PAPER) continue;
    const auto blocks = posed(scene.tile, scene.motion, COUNT);
    for (int blade = 0; blade < COUNT; ++blade) {
      const double wanted = traitsOf(scene.tile, blade).length;
      const double length = polylineLength([&](int i) { return pointOf(blocks, blade, i); });
      // Coordinates of some metres carry 2e-7 m each.
      ASSERT_NEAR(length, wanted, 1e-5 * wanted + 2e-6);
    }
  }
}

// S2-26, E16: whatever blows and treads at once, no point of a blade is below its ground.
TEST(BladeBatch, NoBladeIsPressedIntoTheGround) {
  const CrushPatch patch = rampPatch(1.5f, 0.6f, -0.8f);
  for (const Scene& scene : scenes(patch)) {
    const auto blocks = posed(scene.tile, scene.motion, COUNT);
    for (int blade = 0; blade < COUNT; ++blade) {
      const Vec3 root = pointOf(blocks, blade, 0);
      Vec3 normal = Vec3::UnitZ();
      if (scene.tile.sloped)
        normal = slopedGround(0.3, -0.1).normal(scene.tile.x + root.x(), scene.tile.y + root.y());
      for (int i = 1; i < POINTS; ++i)
        ASSERT_GT(dot(pointOf(blocks, blade, i) - root, normal), -2e-6);
    }
  }
}

// Slopes of 60 degrees are as others: roots stand on them, blades keep their length and stay above.
TEST(BladeBatch, BladesStandOnSlopesOf60Degrees) {
  const terrain::HeightMap hill = slopedGround(std::sqrt(3.0), 0.0);
  const CrushPatch patch = rampPatch(1.5f, 0.6f, -0.8f);
  const Tile tile = makeTile(FeatureMap(), hill, 1, 4, 6);
  TileMotion trodden;
  trodden.crush = &patch;
  for (const TileMotion& motion : {TileMotion(), trodden}) {
    const auto blocks = posed(tile, motion, COUNT);
    for (int blade = 0; blade < COUNT; ++blade) {
      const Vec3 root = pointOf(blocks, blade, 0);
      const double east = tile.x + root.x(), north = tile.y + root.y();
      ASSERT_NEAR(root.z() + tile.z, hill.height(east, north), 1e-5);
      const double wanted = traitsOf(tile, blade).length;
      ASSERT_NEAR(polylineLength([&](int i) { return pointOf(blocks, blade, i); }), wanted,
                  1e-5 * wanted + 2e-6);
      for (int i = 1; i < POINTS; ++i)
        ASSERT_GT(dot(pointOf(blocks, blade, i) - root, hill.normal(east, north)), -2e-6);
    }
  }
}

TEST(BladeBatch, RootsStandOnTheTerrain) {
  const terrain::HeightMap hill = slopedGround(0.3, -0.1);
  const Tile tile = makeTile(FeatureMap(), hill, 1, 4, 6);
  const auto blocks = posed(tile, TileMotion(), COUNT);
  for (int blade = 0; blade < COUNT; ++blade) {
    const Vec3 root = pointOf(blocks, blade, 0);
    ASSERT_NEAR(root.z() + tile.z, hill.height(tile.x + root.x(), tile.y + root.y()), 1e-5);
  }
}

// S2-26: where grass is trodden flat, tips are within 10 degrees of the ground and point along the
// tread, whatever the wind.
TEST(BladeBatch, TroddenBladesLieAlongTheTread) {
  CrushPatch patch = rampPatch(0.f, 0.f, 0.f);
  for (std::size_t i = 0; i < patch.tilt.size(); ++i) {
    patch.tilt[i] = 1.5f;
    patch.tx[i] = 1.5f * 0.6f;
    patch.ty[i] = 1.5f * -0.8f;
  }
  TileMotion motion;
  motion.crush = &patch;
  motion.wind_x = {9.f, 9.f, 9.f, 9.f};
  const auto blocks = posed(tileOf({400.f, 400.f, 400.f, 400.f}), motion, COUNT);
  for (int blade = 0; blade < COUNT; ++blade) {
    const Vec3 tip = pointOf(blocks, blade, LINKS) - pointOf(blocks, blade, 0);
    const double flat = std::hypot(tip.x(), tip.y());
    ASSERT_LT(tip.z() / flat, std::tan(10.0 * PI / 180.0));
    ASSERT_GT((tip.x() * 0.6 - tip.y() * 0.8) / flat, 0.999);
  }
}

TEST(BladeBatch, OfNoBladesTouchesNothing) {
  poseBlades(tileOf({0.f, 0.f, 0.f, 0.f}), TileMotion(), 0, nullptr);
  poseBladesPlain(tileOf({0.f, 0.f, 0.f, 0.f}), TileMotion(), 0, nullptr);
}

}  // namespace
}  // namespace vegetation_sim::grass
