// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/trunk_markers.h"

#include <gtest/gtest.h>

#include <sstream>

#include "forest/export.h"
#include "ros/conversions/crowd_conversions.h"
#include "scenes/forest/forest_fixture.h"
#include "scenes/grass/grass_fixture.h"

namespace vegetation_sim {
namespace {

// N14: rviz, people and the exported table have the same trunks, on a slope and in tiles.
TEST(TrunkMarkers, StandWhereTheTableAndTheObstaclesOfPeopleHaveThem) {
  forest::Layout layout = forest::gridLayout(2, 5.0);
  forest::Tile tile;
  tile.first_tree = 4;
  tile.count = 30;
  tile.x = tile.y = 10.0;
  tile.size = 20.0;
  tile.mix.assign(layout.species.size(), 1.f);
  layout.tiles = {tile};
  const terrain::HeightMap ground = grass::slopedGround(0.3, -0.1);
  const visualization_msgs::MarkerArray markers = trunkMarkersOf(layout, ground, "map", 100, {});
  const auto obstacles = trunksOf(layout, TrunkShape::ROUND, {-100, 100, -100, 100}, 0.0, 100);
  std::ostringstream table;
  writeTable(layout, ground, table);
  std::istringstream lines(table.str());
  std::string line;
  std::getline(lines, line);
  ASSERT_EQ(markers.markers.size(), 35u);
  ASSERT_EQ(obstacles.size(), 34u);
  EXPECT_EQ(markers.markers[0].action, visualization_msgs::Marker::DELETEALL);
  for (int id = 0; id < 34; ++id) {
    const visualization_msgs::Marker& marker = markers.markers[std::size_t(id) + 1];
    EXPECT_EQ(marker.id, id);
    EXPECT_EQ(marker.header.frame_id, "map");
    ASSERT_TRUE(std::getline(lines, line));
    std::vector<double> numbers;
    std::istringstream row(line);
    for (std::string word; std::getline(row, word, ',');)
      numbers.push_back(numbers.size() == 1 ? 0.0 : std::stod(word));
    EXPECT_EQ(numbers[0], id);
    EXPECT_NEAR(marker.pose.position.x, numbers[2], 1e-6);
    EXPECT_NEAR(marker.pose.position.y, numbers[3], 1e-6);
    EXPECT_NEAR(marker.pose.position.z - 0.5 * marker.scale.z, numbers[4], 1e-6);
    EXPECT_NEAR(0.5 * marker.scale.x, numbers[5], 1e-6);
    const crowd::Obstacle& obstacle = obstacles[std::size_t(id)];
    EXPECT_EQ(marker.pose.position.x, obstacle.centre().x);
    EXPECT_EQ(marker.pose.position.y, obstacle.centre().y);
    EXPECT_NEAR(0.5 * marker.scale.x, obstacle.reach, 1e-12);
    EXPECT_GT(marker.scale.z, 0.0);
  }
  EXPECT_EQ(trunkMarkersOf(layout, ground, "map", 3, {}).markers.size(), 4u);
}

TEST(TrunkMarkers, EndWhereTheirTrunksHaveBroken) {
  const forest::Layout layout = forest::gridLayout(2, 5.0);
  const terrain::HeightMap ground = grass::slopedGround(0.3, -0.1);
  const forest::Skeleton tree = grow(layout.trees[1], layout.species[layout.trees[1].species]);
  const auto of_depth = [&](int depth, int after) {
    int id = after + 1;
    while (tree.branches.at(std::size_t(id)).depth != depth) ++id;
    return id;
  };
  const auto piece = [](int branch) {
    forest::BrokenBranch out;
    out.branch = branch;
    return out;
  };
  forest::BrokenTrees broken;
  const int twig = of_depth(1, 0), low = of_depth(0, 0), high = of_depth(0, low);
  broken[1] = {piece(twig)};
  const auto whole = trunkMarkersOf(layout, ground, "map", 100, {}).markers;
  EXPECT_EQ(trunkMarkersOf(layout, ground, "map", 100, broken).markers[2].scale.z,
            whole[2].scale.z);
  broken[1] = {piece(twig), piece(high), piece(low)};
  const auto left = trunkMarkersOf(layout, ground, "map", 100, broken).markers;
  const double height = tree.branches[std::size_t(low)].rest.position.z();
  EXPECT_EQ(left[2].scale.z, height);
  EXPECT_LT(height, 0.9 * whole[2].scale.z);
  EXPECT_NEAR(left[2].pose.position.z - 0.5 * height,
              whole[2].pose.position.z - 0.5 * whole[2].scale.z, 1e-9);
  EXPECT_EQ(left[2].pose.position.x, whole[2].pose.position.x);
  EXPECT_EQ(left[1], whole[1]);
  EXPECT_EQ(left[3], whole[3]);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
