// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/grass_species.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace vegetation_sim::grass
