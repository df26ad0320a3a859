// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/species.h"

#include <gtest/gtest.h>

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
