// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/feature_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "terrain/image_fixture.h"

namespace vegetation_sim::grass {
namespace {

constexpr double ROUNDING = 1e-12;  // of values up to 1000

// Densities at the nodes, 2 m apart, from (10, 20); one grey level is 10 blades/m^2.
//
//   y = 22   5   6   9      north: the picture's first row
//   y = 20   1   2   4
//       x = 10  12  14
MapInput smallMap() {
  MapInput input;
  input.law.origin_x = 10.0;
  input.law.origin_y = 20.0;
  input.density = {0.0, {3, 2, 10, {5, 6, 9, 1, 2, 4}}, 0.0, 100.0};
  return input;
}

// S2-02: at a node its value, in a tile's middle the mean of four.
TEST(FeatureMap, IsExactAtNodesAndTheMeanOfFourAtCentres) {
  const FeatureMap map(smallMap());
  EXPECT_EQ(map.tileColumns(), 2);
  EXPECT_EQ(map.tileRows(), 1);
  EXPECT_NEAR(map.at(10.0, 20.0).density, 10.0, ROUNDING);
  EXPECT_NEAR(map.at(14.0, 22.0).density, 90.0, ROUNDING);
  EXPECT_NEAR(map.at(11.0, 21.0).density, 10.0 * (1 + 2 + 5 + 6) / 4, ROUNDING);
  EXPECT_NEAR(map.at(13.5, 20.0).density, 35.0, ROUNDING);
  EXPECT_NEAR(map.node(2, 0).density, 40.0, ROUNDING);
}

// S2-02: every feature is interpolated.
TEST(FeatureMap, InterpolatesEveryFeature) {
  MapInput input;
  const terrain::GreyImage ramp{2, 2, 1, {0, 1, 0, 1}};
  input.height = {0.0, ramp, 0.1, 0.5};
  input.colour = {0.0, ramp, 0.2, 0.6};
  input.shape = {0.0, ramp, 1.0, 0.0};
  input.species = {{Species(), {0.0, ramp, 0.0, 8.0}}};
  const Features f = FeatureMap(input).at(0.5, 1.0);  // a quarter of 2 m
  EXPECT_NEAR(f.height, 0.2, ROUNDING);
  EXPECT_NEAR(f.colour, 0.3, ROUNDING);
  EXPECT_NEAR(f.shape, 0.75, ROUNDING);
  EXPECT_NEAR(f.mix[0], 2.0, ROUNDING);
  EXPECT_NEAR(f.density, 400.0, ROUNDING);
}

TEST(FeatureMap, HasNoGrassBeyondTheBorder) {
  const FeatureMap map(smallMap());
  for (const double x : {9.99, 14.01, 1e300, std::nan("")})
    EXPECT_EQ(map.at(x, 21.0).density, 0.0) << x;
  EXPECT_EQ(map.at(11.0, std::nan("")).density, 0.0);
}

TEST(FeatureMap, HashDistinguishesMaps) {
  MapInput other = smallMap();
  other.density.image.samples[3] = 3;
  MapInput species = smallMap();
  species.species.emplace_back();
  species.species[0].species.lean = 0.1;
  EXPECT_EQ(FeatureMap(smallMap()).hash(), FeatureMap(smallMap()).hash());
  EXPECT_NE(FeatureMap(smallMap()).hash(), FeatureMap(other).hash());
  EXPECT_NE(FeatureMap(smallMap()).hash(), FeatureMap(species).hash());
}

TEST(FeatureMap, KnowsItsTallestBlade) {
  MapInput input = smallMap();
  input.height = {0.0, {3, 2, 10, {1, 2, 3, 4, 10, 0}}, 0.1, 0.6};
  input.species.resize(2);
  input.species[1].species.name = "poppy";
  input.species[1].species.height = 1.5;
  EXPECT_NEAR(FeatureMap(input).tallest(), 0.9, ROUNDING);
}

TEST(FeatureMap, RejectsBadLayersWithTheirNames) {
  MapInput input = smallMap();
  input.height.value = std::nan("");
  input.colour = {0.0, {2, 2, 255, {1, 2, 3, 4}}, 0.0, 1.0};
  input.density.black = -3.0;
  EXPECT_EQ(errorOf([&] { FeatureMap map(input); }),
            "grass: height: value = nan m is not finite, allowed is 0 to 3 m\n"
            "grass: density: black = -3 1/m^2 is outside 0 to 20000 1/m^2\n"
            "grass: colour: image is 2 x 2 with 4 samples where the map has 3 x 2 nodes");
}

TEST(FeatureMap, RejectsMoreBladesThanATileHolds) {
  MapInput input;
  input.law.resolution = 100.0;
  const std::string error = errorOf([&] { FeatureMap map(input); });
  EXPECT_NE(error.find("blades in a tile, allowed are fewer than 1048576"), std::string::npos);
}

TEST(FeatureMap, RejectsSpeciesWithEqualNames) {
  MapInput input;
  input.species.resize(2);
  EXPECT_EQ(errorOf([&] { FeatureMap map(input); }), "grass: species 'grass' is defined twice");
}

class FeatureMapFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& yaml) {
    folder_.write("meadow.yaml", yaml);
    return errorOf([&] { FeatureMap::load(file_); });
  }

  terrain::Folder folder_;
  std::string image_{folder_.write("dense.pgm", "P2 3 2 10 5 6 9 1 2 4")};
  std::string file_{folder_.write("meadow.yaml", "")};
};

// S2-03, S2-W2: a grey picture gives the density; several species share the map.
TEST_F(FeatureMapFile, ReadsPicturesAndSpecies) {
  folder_.write(
      "meadow.yaml",
      "{resolution: 0.5, density: {image: dense.pgm, white: 1000}, height: {value: 0.4},"
      " species: [{name: fescue}, {name: poppy, flower_radius: 0.03, mix: {value: 0.1}}]}");
  const FeatureMap map = FeatureMap::load(file_);
  EXPECT_EQ(map.law().columns, 3);
  EXPECT_NEAR(map.at(1.0, 0.0).density, 400.0, ROUNDING);
  EXPECT_NEAR(map.at(0.0, 0.5).density, 500.0, ROUNDING);
  EXPECT_NEAR(map.at(0.2, 0.2).height, 0.4, ROUNDING);
  ASSERT_EQ(map.species().size(), 2u);
  EXPECT_EQ(map.species()[1].species.name, "poppy");
  EXPECT_NEAR(map.at(0.2, 0.2).mix[1], 0.1, ROUNDING);
}

TEST_F(FeatureMapFile, ReportsAllFaultsAtOnceWithTheirNames) {
  const std::string error = refusal(
      "{resolution: 0, density: {image: hole.pgm}, height: {value: 0.2, image: dense.pgm},"
      " shape: {white: 0.5}, colour: {value: .nan}, hight: 1, species: [{lean: 3}]}");
  for (const char* part :
       {"resolution = 0 m is outside 0.1 to 100 m", "species[0]: name is missing",
        "species[0]: lean = 3 rad is outside 0 to 1.4 rad", "density: ", "hole.pgm: cannot be read",
        "height: value and image are both given; only one is allowed",
        "shape: white is given without image",
        "colour: value = nan is not finite, allowed is 0 to 1", "hight is not a known key"})
    EXPECT_NE(error.find(part), std::string::npos) << part << " in\n" << error;
}

TEST_F(FeatureMapFile, RejectsPicturesThatDoNotFitTogether) {
  folder_.write("other.pgm", "P2 2 2 10 5 6 9 1");
  const std::string error =
      refusal("{density: {image: dense.pgm}, height: {image: other.pgm, white: 0.5}}");
  EXPECT_NE(error.find("meadow.yaml: grass: density: image is 3 x 2"), std::string::npos) << error;
}

TEST_F(FeatureMapFile, RejectsAFileThatIsNoPicture) {
  folder_.write("words.png", "words");
  const std::string error = refusal("{density: {image: words.png}}");
  EXPECT_NE(error.find("words.png: neither a PNG nor a PGM"), std::string::npos) << error;
}

}  // namespace
}  // namespace vegetation_sim::grass
