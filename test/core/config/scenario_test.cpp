// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/scenario.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

TEST(Scenario, LeavesTheSectionsOfOtherNodesAlone) {
  Scenario scenario = Scenario::parse(
      "{frame_id: odom, seed: 4, terrain: {a: 1}, wind: {b: 2}, forest: {c: 3}, viewer: {d: 4}}",
      "scene.yaml");
  std::string frame;
  scenario.top().text("frame_id", frame);
  EXPECT_EQ(frame, "odom");
  EXPECT_TRUE(scenario.has("forest"));
  EXPECT_FALSE(scenario.has("grass"));
  EXPECT_NO_THROW(scenario.finish());
}

TEST(Scenario, RefusesUnknownKeysTogetherWithTheFaultsOfItsSections) {
  Scenario scenario = Scenario::parse("{forrest: {}, wind: {speed: fast}}", "scene.yaml");
  YamlSection wind = scenario.section("wind");
  double speed = 0.0;
  wind.number("speed", speed, "m/s", {0.0, 9.0});
  try {
    scenario.finish();
    FAIL() << "took it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "scene.yaml: wind: speed = 'fast' is not a number\n"
                 "scene.yaml: forrest is not a known key; known are frame_id, seed, terrain, wind, "
                 "forest, physics, grass, canopy, crowd, viewer");
  }
}

TEST(Scenario, NamesAFileThatIsMissing) {
  try {
    Scenario::load("/nowhere/scene.yaml");
    FAIL() << "loaded it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "/nowhere/scene.yaml: cannot be read: No such file or directory");
  }
}

TEST(Scenario, RefusesWhatIsNoMapOfSections) {
  Scenario scenario = Scenario::parse("[1, 2]", "scene.yaml");
  EXPECT_THROW(scenario.finish(), InvalidInput);
  EXPECT_THROW(Scenario::parse("{a: [", "scene.yaml"), InvalidInput);
}

TEST(Scenario, StillWorksAfterItWasMoved) {
  Scenario first = Scenario::parse("wind: {speed: fast}", "scene.yaml");
  Scenario second = std::move(first);
  YamlSection wind = second.section("wind");
  double speed = 0.0;
  wind.number("speed", speed, "m/s", {0.0, 9.0});
  EXPECT_EQ(second.faults().list().size(), 1u);
}

}  // namespace
}  // namespace vegetation_sim
