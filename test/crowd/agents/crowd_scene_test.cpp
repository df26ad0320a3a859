// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_scene.h"

#include <gtest/gtest.h>

namespace vegetation_sim::crowd {
namespace {

Scene read(const std::string& text, Faults& faults) {
  YamlSection section(parseYaml(text, "scene"), "scene: crowd", faults);
  Scene out = readScene(section, 5, faults);
  section.finish();
  return out;
}

TEST(CrowdScene, HasWallsWalkersAndGroups) {
  Faults faults;
  const Scene scene = read(R"(
behaviour: paper
sensor_range: 2.5
area: {min_x: -5, max_x: 5, min_y: 0, max_y: 8}
walls: [{from: [-5, 0, 0], to: [5, 0, 0], thickness: 0.2}]
walkers: [{x: 1, y: 2, speed: 1.5, goal: [4, 4, 0]}]
groups: [{count: 20, x: -2, y: 4, spread: 1.0}]
)",
                           faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  EXPECT_EQ(scene.settings.behaviour, Behaviour::PAPER);
  EXPECT_EQ(scene.area.max_y, 8.0);
  ASSERT_EQ(scene.spawns.size(), 21U);
  EXPECT_TRUE(scene.spawns[0].has_goal);
  EXPECT_FALSE(scene.spawns[0].wanders);
  EXPECT_NEAR(scene.spawns[20].position.x, -2.0, 1.0);
  EXPECT_NE(scene.spawns[19].speed, scene.spawns[20].speed);
  EXPECT_EQ(obstaclesOf(scene.walls).size(), 1U);
}

// The fastest and tallest there may be are not outdone by those about them.
TEST(CrowdScene, GroupsKeepWithinWhatAWalkerMayHave) {
  Spawn like;
  like.speed = 3.0;
  like.height = 2.5;
  like.position = {1e5, 0.0};
  int fastest = 0;
  for (const Spawn& one : groupOf(like, 50, 3.0, 0.3, Random(5))) {
    EXPECT_LE(one.speed, 3.0);
    EXPECT_LE(one.height, 2.5);
    EXPECT_LE(one.position.x, 1e5);
    fastest += one.speed == 3.0;
  }
  EXPECT_GT(fastest, 10);
  EXPECT_LT(fastest, 40);
}

TEST(CrowdScene, ReportsAllFaultsAtOnce) {
  Faults faults;
  read(R"(
sensor_range: 500
speeed: 3
area: {min_x: 5, max_x: -5}
walls: [{from: [0, 0, 0]}]
walkers: [{x: 1, speed: 40}]
)",
       faults);
  const std::string text = faults.text();
  for (const char* part : {"sensor_range = 500 m is outside 0.5 to 20", "speeed", "area",
                           "walls[0]", "needs from and to", "speed = 40 m/s is outside 0.1 to 3"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

}  // namespace
}  // namespace vegetation_sim::crowd
