// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Every file of config/scenarios is read as each node reads it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "nodes/canopy/canopy_options.h"
#include "nodes/crowd/crowd_options.h"
#include "nodes/forest/forest_options.h"
#include "nodes/grass/grass_options.h"
#include "package_folder.h"
#include "vegetation_sim/canopy/plants/leaf.h"
#include "wind/wind_reader.h"

namespace vegetation_sim {
namespace {

/// Returns the files by name.
std::vector<std::string> scenarios() {
  std::vector<std::string> out;
  for (const auto& file : std::filesystem::directory_iterator(PACKAGE_FOLDER "/config/scenarios"))
    if (file.path().extension() == ".yaml") out.push_back(file.path().string());
  std::sort(out.begin(), out.end());
  return out;
}

class ScenarioFiles : public testing::TestWithParam<std::string> {
 protected:
  bool has(const char* section) const { return Scenario::load(GetParam()).has(section); }
};

TEST_P(ScenarioFiles, HaveTheTreesOfTheirForest) {
  const ForestScene scene = loadForestScene(GetParam());
  EXPECT_EQ(scene.layout.treeCount() > 0, has("forest"));
}

// Files of meshes and of slices are read, too.
TEST_P(ScenarioFiles, HaveThePlantsOfTheirCanopy) {
  const CanopyScene scene = loadCanopyScene(GetParam());
  EXPECT_EQ(!scene.layout.plants.empty() || !scene.layout.crowns.empty(), has("canopy"));
  for (const canopy::PlantKind& kind : scene.layout.kinds) {
    if (!canopy::isRead(kind)) continue;
    ASSERT_NE(kind.form, nullptr) << kind.name;
    EXPECT_FALSE(kind.form->leaves.empty()) << kind.name;
  }
}

TEST_P(ScenarioFiles, HaveTheBladesOfTheirGrass) {
  const GrassScene scene = loadGrassScene(GetParam());
  const grass::FeatureMap& map = *scene.grass.layout.map;
  bool grows = false;
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column)
      grows = grows || map.node(column, row).density > 0.0;
  EXPECT_EQ(grows, has("grass"));
}

TEST_P(ScenarioFiles, HaveThePeopleOfTheirCrowd) {
  const CrowdScene scene = loadCrowdScene(GetParam());
  EXPECT_EQ(!scene.crowd.spawns.empty(), has("crowd"));
}

TEST_P(ScenarioFiles, HaveWind) {
  Scenario scenario = Scenario::load(GetParam());
  std::uint64_t seed = 0;
  YamlSection section = scenario.section("wind");
  EXPECT_FALSE(wind::readWind(section, seed).empty());
  EXPECT_TRUE(scenario.faults().empty()) << scenario.faults().text();
}

INSTANTIATE_TEST_SUITE_P(Shipped, ScenarioFiles, testing::ValuesIn(scenarios()),
                         [](const testing::TestParamInfo<std::string>& file) {
                           return std::filesystem::path(file.param).stem().string();
                         });

TEST(ShippedScenarios, AreFound) {
  EXPECT_GE(scenarios().size(), 19u);
}

std::string fileOf(const char* name) {
  return std::string(PACKAGE_FOLDER "/config/scenarios/") + name + ".yaml";
}

// N11: added mass and drag of the kelp are those of sea water, of 1020 to 1030 kg/m^3.
TEST(ShippedScenarios, TheReefIsInSeaWater) {
  const ForestScene scene = loadForestScene(fileOf("reef"));
  ASSERT_FALSE(scene.layout.species.empty());
  for (const forest::Species& species : scene.layout.species)
    EXPECT_NEAR(species.fluid_density, 1025.0, 5.0) << species.name;
}

// S3-W6: clouds are puffs and not leaves.
TEST(ShippedScenarios, CloudsAreSlicesOfPuffs) {
  const CanopyScene scene = loadCanopyScene(fileOf("clouds"));
  ASSERT_FALSE(scene.layout.kinds.empty());
  for (const canopy::PlantKind& kind : scene.layout.kinds) {
    EXPECT_EQ(kind.shape, canopy::PlantShape::SLICES) << kind.name;
    EXPECT_EQ(kind.look, canopy::CellLook::PUFFS) << kind.name;
  }
}

// S2-18: discs of dry grass drift below the clouds.
TEST(ShippedScenarios, DiscsOfColourMoveBelowTheClouds) {
  const GrassScene scene = loadGrassScene(fileOf("clouds"));
  EXPECT_FALSE(scene.colours.empty());
  for (const grass::ColourMask& disc : scene.colours)
    EXPECT_GT(std::hypot(disc.velocity.x, disc.velocity.y), 0.1) << disc.centre.x;
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
