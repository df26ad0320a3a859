// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/terrain/height_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "package_folder.h"
#include "terrain/image_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::terrain {
namespace {

// Samples of the map below, 2 m apart, from (10, 20); one grey level is 0.1 m, black is at 3 m.
//
//   y = 22   5   6   9      north: the picture's first row
//   y = 20   1   2   4
//       x = 10  12  14
HeightMap smallMap() {
  HeightMapLaw law;
  law.resolution = 2.0;
  law.origin = Vec3(10.0, 20.0, 1.0);
  law.height_min = 2.0;
  law.height_max = 3.0;
  return HeightMap(law, {3, 2, 10, {5, 6, 9, 1, 2, 4}});
}

double metres(double level) {
  return 3.0 + 0.1 * level;
}

constexpr double ROUNDING = 1e-14;  // [m] a few units in the last place of 4 m

TEST(HeightMap, WithoutAFileIsFlat) {
  const HeightMap flat = HeightMap::load("");
  EXPECT_TRUE(flat.isFlat());
  EXPECT_EQ(flat.height(1e6, -3.0), 0.0);
  EXPECT_EQ(flat.normal(5.0, 5.0), Vec3::UnitZ());
  EXPECT_EQ(flat.bounds().max_z, 0.0);
  EXPECT_TRUE(std::isinf(flat.bounds().max_x));
}

// The height at a node is its value, in a cell's middle the mean of four.
TEST(HeightMap, IsExactAtNodesAndTheMeanOfFourAtCentres) {
  const HeightMap map = smallMap();
  EXPECT_NEAR(map.height(10.0, 20.0), metres(1), ROUNDING);
  EXPECT_NEAR(map.height(12.0, 20.0), metres(2), ROUNDING);
  EXPECT_NEAR(map.height(14.0, 22.0), metres(9), ROUNDING);
  EXPECT_NEAR(map.height(11.0, 21.0), metres((1 + 2 + 5 + 6) / 4.0), ROUNDING);
  EXPECT_NEAR(map.height(13.0, 21.0), metres((2 + 4 + 6 + 9) / 4.0), ROUNDING);
}

TEST(HeightMap, HasThePicturesFirstRowInTheNorth) {
  const HeightMap map = smallMap();
  EXPECT_GT(map.height(10.0, 22.0), map.height(10.0, 20.0));
  EXPECT_GT(map.height(14.0, 20.0), map.height(10.0, 20.0));
}

TEST(HeightMap, GoesOnAtTheBordersHeightBeyondIt) {
  const HeightMap map = smallMap();
  EXPECT_EQ(map.height(-1e9, 20.0), map.height(10.0, 20.0));
  EXPECT_EQ(map.height(1e300, 1e300), map.height(14.0, 22.0));
  EXPECT_EQ(map.height(11.0, 19.0), map.height(11.0, 20.0));
  EXPECT_EQ(map.height(std::nan(""), 20.0), map.height(10.0, 20.0));
  EXPECT_EQ(map.normal(-5.0, 0.0), Vec3::UnitZ());
}

TEST(HeightMap, IsContinuousAcrossCellBorders) {
  const HeightMap map = smallMap();
  constexpr double STEP = 1e-9;  // [m]; slopes are below 1
  EXPECT_NEAR(map.height(12.0 - STEP, 20.7), map.height(12.0 + STEP, 20.7), 2.0 * STEP);
  EXPECT_NEAR(map.height(14.0 - STEP, 20.7), map.height(14.0 + STEP, 20.7), 2.0 * STEP);
}

TEST(HeightMap, NormalIsThatOfFiniteDifferences) {
  const HeightMap map = HeightMap::load(std::string(PACKAGE_FOLDER) + "/config/terrain/hills.yaml");
  constexpr double STEP = 1e-4;  // [m]
  const Random random(3);
  for (int i = 0; i < 500; ++i) {
    // Away from cell borders, where the slope jumps.
    const double x =
        std::floor(random.uniform(4 * i, -120, 120)) + random.uniform(4 * i + 1, .1, .9);
    const double y =
        std::floor(random.uniform(4 * i + 2, -120, 120)) + random.uniform(4 * i + 3, .1, .9);
    const double slope_x = (map.height(x + STEP, y) - map.height(x - STEP, y)) / (2.0 * STEP);
    const double slope_y = (map.height(x, y + STEP) - map.height(x, y - STEP)) / (2.0 * STEP);
    const Vec3 expected = Vec3(-slope_x, -slope_y, 1.0).normalized();
    EXPECT_LT((map.normal(x, y) - expected).norm(), 1e-9) << x << ' ' << y;
  }
}

TEST(HeightMap, BoundsHoldEveryHeight) {
  const Bounds b = smallMap().bounds();
  EXPECT_EQ(b.min_x, 10.0);
  EXPECT_EQ(b.max_x, 14.0);
  EXPECT_EQ(b.min_y, 20.0);
  EXPECT_EQ(b.max_y, 22.0);
  EXPECT_NEAR(b.min_z, metres(1), ROUNDING);
  EXPECT_NEAR(b.max_z, metres(9), ROUNDING);
}

TEST(HeightMap, OfOneSampleOrOneRowIsDefinedEverywhere) {
  const HeightMap point({}, {1, 1, 10, {5}});
  EXPECT_EQ(point.height(0.0, 0.0), 0.5);
  EXPECT_EQ(point.height(7.0, -7.0), 0.5);
  const HeightMap row({}, {2, 1, 10, {0, 10}});
  EXPECT_EQ(row.height(0.5, 3.0), 0.5);
  EXPECT_EQ(row.normal(0.5, 0.0), Vec3(-1.0, 0.0, 1.0) * (1.0 / std::sqrt(2.0)));
}

TEST(HeightMap, HashDependsOnSamplesAndLaw) {
  const HeightMap one({}, {2, 1, 10, {0, 10}}), same({}, {2, 1, 10, {0, 10}});
  const HeightMap other({}, {2, 1, 10, {0, 9}}), upright({}, {1, 2, 10, {0, 10}});
  HeightMapLaw steeper;
  steeper.height_max = 2.0;
  EXPECT_EQ(one.hash(), same.hash());
  EXPECT_NE(one.hash(), other.hash());
  EXPECT_NE(one.hash(), upright.hash());
  EXPECT_NE(one.hash(), HeightMap(steeper, {2, 1, 10, {0, 10}}).hash());
}

TEST(HeightMap, ShippedHillsAreGentleAroundTheOrigin) {
  const HeightMap map = HeightMap::load(std::string(PACKAGE_FOLDER) + "/config/terrain/hills.yaml");
  EXPECT_NEAR(map.height(0.0, 0.0), 0.0, 0.1);
  EXPECT_EQ(map.bounds().min_x, -128.0);
  EXPECT_EQ(map.bounds().max_y, 128.0);
  EXPECT_NEAR(map.bounds().max_z - map.bounds().min_z, 8.0, 1e-9);
  EXPECT_GT(map.normal(5.0, 5.0).z(), std::cos(0.1));
}

class HeightMapFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& yaml) {
    folder_.write("hill.yaml", yaml);
    return errorOf([&] { HeightMap::load(file_); });
  }

  Folder folder_;
  std::string image_{folder_.write("hill.png", grey8({0, 255, 128, 64}, 2))};
  std::string file_{folder_.write("hill.yaml", "")};
};

TEST_F(HeightMapFile, NamesItsPictureRelativeToItself) {
  const std::string file = folder_.write(
      "hill.yaml", "{image: hill.png, resolution: 0.5, origin: [-1, -2, 3], height_max: 2.55}");
  EXPECT_NEAR(HeightMap::load(file).height(-1.0, -1.5), 3.0, ROUNDING);
  EXPECT_NEAR(HeightMap::load(file).height(-0.5, -2.0), 3.64, ROUNDING);
}

TEST_F(HeightMapFile, ReportsAllFaultsAtOnceWithTheirNames) {
  const std::string error = refusal("{resolution: .nan, origin: [0, 0], hight_max: 3}");
  EXPECT_EQ(error,
            file_ + ": resolution = nan m is not finite, allowed is 0.001 to 1000 m\n" + file_ +
                ": origin has 2 numbers; 3 are expected\n" + file_ +
                ": image is missing: the path of a PNG or PGM file\n" + file_ +
                ": height_max is missing\n" + file_ +
                ": hight_max is not a known key; known are height_max, height_min, image, origin, "
                "resolution");
}

TEST_F(HeightMapFile, RefusesValuesOutOfRange) {
  EXPECT_EQ(refusal("{image: hill.png, resolution: 0, height_max: 2}"),
            file_ + ": resolution = 0 m is outside 0.001 to 1000 m");
  EXPECT_EQ(refusal("{image: hill.png, resolution: fine, height_max: 2}"),
            file_ + ": resolution = 'fine' is not a number");
  EXPECT_EQ(refusal("{image: hill.png, resolution: 1, height_min: 3, height_max: 2}"),
            file_ + ": height_max = 2.000000 m is below height_min = 3.000000 m");
}

TEST_F(HeightMapFile, NamesAPictureThatIsMissingOrNone) {
  const std::string missing = refusal("{image: hole.png, resolution: 1, height_max: 2}");
  EXPECT_NE(missing.find("hole.png: cannot be read: No such file"), std::string::npos) << missing;
  folder_.write("words.png", "words");
  const std::string words = refusal("{image: words.png, resolution: 1, height_max: 2}");
  EXPECT_NE(words.find("words.png: neither a PNG nor a PGM"), std::string::npos) << words;
}

TEST_F(HeightMapFile, ThatIsMissingIsNamed) {
  EXPECT_EQ(errorOf([] { HeightMap::load("nowhere.yaml"); }),
            "nowhere.yaml: cannot be read: No such file or directory");
}

TEST(HeightMap, RefusesAnImageWhoseSizesDoNotFit) {
  const std::string error = errorOf([] { HeightMap({}, {2, 2, 10, {1, 2, 3}}); });
  EXPECT_EQ(error, "terrain: image has 3 samples for 2 x 2, each side 1 to 8192");
}

}  // namespace
}  // namespace vegetation_sim::terrain
