// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/species.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

std::string faultOf(const std::string& yaml) {
  try {
    parseSpecies(yaml, "tree.yaml");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

class ShippedSpecies : public testing::TestWithParam<std::string> {};

TEST_P(ShippedSpecies, SurvivesWritingToTheBit) {
  const Species species = shippedSpecies(GetParam());
  EXPECT_EQ(hash(parseSpecies(writeSpecies(species), "copy")), hash(species));
}
INSTANTIATE_TEST_SUITE_P(Files, ShippedSpecies, testing::ValuesIn(speciesNames()));
INSTANTIATE_TEST_SUITE_P(Crops, ShippedSpecies, testing::Values("vine", "apple"));

std::size_t count(const Species& species, int (*measure)(const Branch&)) {
  std::size_t sum = 0;
  for (std::uint64_t i = 0; i < 8; ++i) {
    TreeSeed seed;
    seed.seed = i;
    for (const Branch& b : grow(seed, species).branches)
      sum += static_cast<std::size_t>(measure(b));
  }
  return sum;
}
std::size_t branches(const Species& s) {
  return count(s, [](const Branch&) { return 1; });
}
std::size_t leaves(const Species& s) {
  return count(s, [](const Branch& b) { return b.leaves; });
}

// S1-10: each design factor changes its property.
TEST(Species, DesignersFactorsChangeTheTree) {
  const Species oak = shippedSpecies("oak");
  const auto with = [&](double Design::*factor, double value) {
    Design design;
    design.*factor = value;
    return applyDesign(oak, design);
  };
  EXPECT_EQ(hash(applyDesign(oak, Design())), hash(oak));
  EXPECT_DOUBLE_EQ(with(&Design::size, 2.0).height, 2.0 * oak.height);
  EXPECT_GT(branches(with(&Design::children, 1.3)), 1.5 * static_cast<double>(branches(oak)));
  EXPECT_LT(leaves(with(&Design::leaves, 0.5)), 0.6 * static_cast<double>(leaves(oak)));
  EXPECT_EQ(leaves(with(&Design::leaves, 0.0)), 0u);
  TreeSeed seed;
  seed.seed = 2;
  EXPECT_LT(grow(seed, with(&Design::angle, 0.3)).reach, 0.9 * grow(seed, oak).reach);
  EXPECT_NE(grow(seed, with(&Design::noise, 0.0)).hash(), grow(seed, oak).hash());
}

// The arms of a vine follow its row; the limbs of other trees grow in any direction.
TEST(Species, TurnHoldsTheTrunkNearTheYawOfTheTree) {
  const auto largestTurn = [](double turn) {
    Species species = shippedSpecies("vine");
    species.noise = 1.0;
    species.turn = turn;
    double out = 0.0;
    for (std::uint64_t i = 0; i < 200; ++i) {
      TreeSeed seed;
      seed.seed = i;
      seed.yaw = 0.4;
      out = std::max(out, std::fabs(grow(seed, species).branches[0].theta - 0.4));
    }
    return out;
  };
  EXPECT_EQ(largestTurn(0.0), 0.0);
  EXPECT_NEAR(largestTurn(0.3), 0.3, 0.01);
  EXPECT_NEAR(largestTurn(PI), PI, 0.1);
  EXPECT_NE(faultOf("{name: a, turn: 4}").find("turn = 4 rad is outside 0 to 3.14159 rad"),
            std::string::npos);
}

TEST(Species, ArmsOfTheVineFollowItsRow) {
  const Species vine = shippedSpecies("vine");
  for (std::uint64_t i = 0; i < 50; ++i) {
    TreeSeed seed;
    seed.seed = i;
    seed.yaw = 0.9;
    for (const Branch& b : grow(seed, vine).branches) {
      if (b.depth != 1) continue;
      const Vec3 along = axisZ(b.rest.orientation);
      const double across = along.y() * std::cos(0.9) - along.x() * std::sin(0.9);
      EXPECT_LT(std::fabs(across), 0.4);
      EXPECT_LT(std::fabs(along.z()), 0.4);
    }
  }
}

TEST(Species, HashSeesTheTurn) {
  Species species = shippedSpecies("oak");
  const std::uint64_t before = hash(species);
  species.turn = 0.1;
  EXPECT_NE(hash(species), before);
}

// Species that never break keep the hash that they had before others could.
TEST(Species, HashSeesAStrengthAboveZero) {
  Species species = shippedSpecies("oak");
  EXPECT_EQ(species.strength, 0.0);
  const std::uint64_t before = hash(species);
  species.strength = 5.7e7;
  EXPECT_NE(hash(species), before);
  EXPECT_EQ(parseSpecies(writeSpecies(species), "copy").strength, 5.7e7);
  EXPECT_NE(faultOf("{name: a, strength: -1}").find("strength = -1 Pa is outside 0 to 1e+12"),
            std::string::npos);
  EXPECT_NE(faultOf("{name: a, strength: .nan}").find("strength"), std::string::npos);
}

// USDA Forest Service, Wood Handbook, FPL-GTR-190 (2010), table 5-3a: modulus of rupture of green
// wood, 33 to 57 MPa.
TEST(Species, ShippedTreesBreakAtTheStrengthOfGreenWood) {
  const auto strengthOf = [](const std::string& name) {
    return loadSpecies(std::string(PACKAGE_FOLDER) + "/config/species/" + name + ".yaml").strength;
  };
  EXPECT_EQ(strengthOf("oak"), 5.7e7);
  EXPECT_EQ(strengthOf("birch"), 4.4e7);
  EXPECT_EQ(strengthOf("pine"), 4.0e7);
  EXPECT_EQ(strengthOf("willow"), 3.3e7);
}

// Trees in air keep the hash that they had before there were other fluids.
TEST(Species, HashSeesAFluidOtherThanAir) {
  Species species = shippedSpecies("oak");
  EXPECT_EQ(species.fluid_density, AIR_DENSITY);
  const std::uint64_t before = hash(species);
  species.fluid_density = 1025.0;
  EXPECT_NE(hash(species), before);
  EXPECT_EQ(parseSpecies(writeSpecies(species), "copy").fluid_density, 1025.0);
  for (const char* value : {"0", "-1", "0.09", "2001"}) {
    const std::string error = faultOf(std::string("{name: a, fluid_density: ") + value + "}");
    EXPECT_NE(error.find(std::string("fluid_density = ") + value +
                         " kg/m^3 is outside 0.1 to 2000 kg/m^3"),
              std::string::npos)
        << error;
  }
  EXPECT_NE(faultOf("{name: a, fluid_density: .nan}").find("fluid_density"), std::string::npos);
  EXPECT_NE(faultOf("{name: a, fluid_density: water}").find("fluid_density"), std::string::npos);
}

class Stage : public testing::TestWithParam<std::string> {};

// Means of eight trees, because numbers of limbs are rounded at random.
TEST_P(Stage, RaisesSizeThicknessLimbsAndLeaves) {
  const Species grown = shippedSpecies(GetParam());
  EXPECT_EQ(hash(applyStage(grown, 1.0)), hash(grown));
  Species before = applyStage(grown, 0.0);
  EXPECT_NEAR(before.height, std::max(0.1, 0.05 * grown.height), 1e-9);
  EXPECT_LT(branches(before), branches(grown));
  TreeSeed seed;
  for (int i = 1; i <= 10; ++i) {
    const Species now = applyStage(grown, 0.1 * i);
    Faults faults;
    check(now, faults);
    EXPECT_EQ(faults.text(), "");
    EXPECT_GE(grow(seed, now).height, grow(seed, before).height);
    EXPECT_GE(now.trunk_radius, before.trunk_radius);
    EXPECT_GE(now.twig_radius, before.twig_radius);
    EXPECT_GE(now.leaf_size, before.leaf_size);
    EXPECT_GE(now.leaf_area, before.leaf_area);
    EXPECT_GE(branches(now), branches(before));
    EXPECT_GE(leaves(now), leaves(before));
    before = now;
  }
}
INSTANTIATE_TEST_SUITE_P(Species, Stage, testing::Values("vine", "apple", "oak"));

TEST(Species, DesignNeverLeavesTheAllowedRanges) {
  for (const std::string& name : speciesNames()) {
    Design wild{3.0, 3.0, 3.0, 2.0, 3.0};
    Faults faults;
    check(applyDesign(shippedSpecies(name), wild), faults);
    EXPECT_TRUE(faults.empty()) << faults.text();
  }
}

// This holds even where the last depth is small.
TEST(Species, DesignThinsOutWhateverDepthIsLarge) {
  const Species wide = parseSpecies(
      "{name: wide, limbs: [{segments: 4}, {children: 60, segments: 2}, {children: 60, segments: "
      "4},"
      " {children: 0.05}]}",
      "wide");
  EXPECT_LE(expectedBranches(applyDesign(wide, Design())), MAX_BRANCHES);
}

TEST(Species, FaultsNameKeyValueAndRange) {
  EXPECT_NE(faultOf("{name: a, height: -1}").find("height = -1 m is outside 0.1 to 100 m"),
            std::string::npos);
  EXPECT_NE(faultOf("{name: a, heigth: 3}").find("heigth is not a known key"), std::string::npos);
  EXPECT_NE(faultOf("{name: a, leaf_shape: star}").find("is none of broad, needle, small, long"),
            std::string::npos);
  EXPECT_NE(faultOf("{name: a, limbs: [{segments: 99}]}").find("segments = 99 is outside 1 to 16"),
            std::string::npos);
  EXPECT_NE(faultOf("{height: 3}").find("name is empty"), std::string::npos);
  EXPECT_NE(faultOf("{name: a, limbs: [{}, {children: 200, segments: 16}, {children: 200}]}")
                .find("more than the 16384 allowed"),
            std::string::npos);
  EXPECT_NE(faultOf("[1, 2").find("not YAML"), std::string::npos);
}

TEST(Species, AllFaultsAreReportedAtOnce) {
  const std::string text = faultOf("{name: a, height: -1, density: x, bogus: 1}");
  EXPECT_NE(text.find("height"), std::string::npos);
  EXPECT_NE(text.find("density"), std::string::npos);
  EXPECT_NE(text.find("bogus"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::forest
