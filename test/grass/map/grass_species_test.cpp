// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/grass_species.h"

#include <gtest/gtest.h>

#include <cmath>

#include "package_folder.h"
#include "vegetation_sim/grass/map/feature_map.h"

namespace vegetation_sim::grass {
namespace {

TEST(GrassSpecies, StageRaisesHeightAndWidthAndBringsTheEars) {
  Species wheat;
  wheat.width = 0.009;
  wheat.flower_radius = 0.02;
  EXPECT_EQ(applyStage(wheat, 1.0).width, 0.009);
  Species before = applyStage(wheat, 0.0);
  EXPECT_DOUBLE_EQ(before.height, 0.05);
  EXPECT_DOUBLE_EQ(before.width, 0.009 * std::sqrt(0.05));
  for (int i = 1; i <= 10; ++i) {
    const Species now = applyStage(wheat, 0.1 * i);
    EXPECT_GT(now.height, before.height);
    EXPECT_GT(now.width, before.width);
    EXPECT_EQ(now.flower_radius, i < 6 ? 0.0 : 0.02);
    before = now;
  }
}

TEST(GrassSpecies, StageIsAKeyOfTheMap) {
  Faults faults;
  YamlSection section(parseYaml("{species: [{name: wheat, height: 2, stage: 0.5}]}", "map"), "map",
                      faults);
  const MapInput input = readMapInput(section, "");
  EXPECT_EQ(faults.text(), "");
  EXPECT_DOUBLE_EQ(input.species.at(0).species.height, 2.0 * 0.525);
}

// N11: crops are described once, in config/grasses.
TEST(GrassSpecies, TakesTheValuesOfItsBase) {
  const auto inputOf = [](const std::string& entry, Faults& faults) {
    YamlSection section(parseYaml("{species: [" + entry + "]}", "map"), "map", faults);
    return readMapInput(section, PACKAGE_FOLDER "/config/scenarios");
  };
  Faults none;
  const MapInput input = inputOf("{base: wheat, lean: 0.3}", none);
  EXPECT_EQ(none.text(), "");
  const Species& wheat = input.species.at(0).species;
  EXPECT_EQ(wheat.name, "wheat");
  EXPECT_EQ(wheat.width, 0.009);
  EXPECT_EQ(wheat.lean, 0.3);
  Faults unknown;
  inputOf("{base: barley}", unknown);
  EXPECT_NE(unknown.text().find("species[0]: base = 'barley': "), std::string::npos)
      << unknown.text();
}

}  // namespace
}  // namespace vegetation_sim::grass
