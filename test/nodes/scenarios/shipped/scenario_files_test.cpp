// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Every file of config/scenarios is read as each node reads it.
#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
