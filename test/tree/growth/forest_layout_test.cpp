// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/forest_layout.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "core/config/scenario.h"
#include "package_folder.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

std::string faultsOf(const Layout& layout) {
  Faults faults;
  check(layout, faults);
  return faults.text();
}

// S1-05: the permanent data of a tree in a message is far below 1 kB.
TEST(Layout, SeedIsSmall) {
  EXPECT_LT(sizeof(TreeSeed), 200u);
}

TEST(Layout, TreesInATileAreAPureFunctionOfTheTile) {
  Tile tile;
  tile.count = 500;
  tile.size = 100.0;
  tile.x = 7.0;
  tile.seed = 3;
  tile.mix = {1.f, 0.f, 3.f};
  int third = 0;
  for (std::uint32_t i = 0; i < tile.count; ++i) {
    const TreeSeed a = seedInTile(tile, i), b = seedInTile(tile, i);
    EXPECT_EQ(a.position, b.position);
    EXPECT_GE(a.position.x(), 7.0);
    EXPECT_LE(a.position.x(), 107.0);
    EXPECT_GE(a.position.y(), 0.0);
    EXPECT_LE(a.position.y(), 100.0);
    EXPECT_NE(a.species, 1);
    third += a.species == 2;
    for (std::uint32_t j = 0; j < i; ++j)  // no trunk stands on another
      ASSERT_GT(length(a.position - seedInTile(tile, j).position), 0.3 * 100.0 / 23.0);
  }
  EXPECT_NEAR(third / 500.0, 0.75, 0.08);  // 4 sigma of a binomial
}

TEST(Layout, UnknownTreeIsNamed) {
  const Layout layout = gridLayout(2, 5.0);
  EXPECT_EQ(seedOf(layout, 3).seed, layout.trees[3].seed);
  try {
    seedOf(layout, 4);
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "tree = 4 is unknown; there are 4, from 0");
  }
}

TEST(Layout, FaultsNameFieldValueAndRange) {
  Layout layout = gridLayout(2, 5.0);
  layout.trees[1].species = 9;
  layout.trees[2].position.x() = NOT_A_NUMBER;
  layout.trees[3].scale = 1000.0;
  layout.motion.transition = -1.0;
  const std::string text = faultsOf(layout);
  for (const char* part :
       {"trees[1]: species = 9 is outside 0 to 3", "trees[2]: position.x = nan m is not finite",
        "trees[3]: scale = 1000 is outside 0.05 to 20",
        "transition = -1 s is outside 0.01 to 60 s"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

// Compares with the positions of all trees.
TEST(Layout, TreesOfATileNearAPointAreFound) {
  Tile tile;
  tile.count = 700;
  tile.size = 60.0;
  tile.x = -10.0;
  tile.mix = {1.f};
  for (const Vec3& point : {Vec3(5, 7, 0), Vec3(-30, 80, 3), Vec3(49.9, 59.9, 0)}) {
    for (const double radius : {0.0, 1.0, 9.0, 40.0, 500.0}) {
      const std::vector<std::uint32_t> found = findTreesInTile(tile, point, radius);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      const double cell = 60.0 / 27.0;
      for (std::uint32_t i = 0; i < tile.count; ++i) {
        const Vec3 off = seedInTile(tile, i).position - point;
        const double distance = std::hypot(off.x(), off.y());
        const bool is_found = std::binary_search(found.begin(), found.end(), i);
        EXPECT_TRUE(is_found || distance > radius) << i << " at " << distance;
        EXPECT_FALSE(is_found && distance > radius + 1.5 * cell) << i << " at " << distance;
      }
    }
  }
}

TEST(Layout, TilesWithGapsAndBadMixAreRefused) {
  Layout layout = gridLayout(1, 5.0);
  Tile tile;
  tile.first_tree = 5;
  tile.count = 3;
  tile.mix = {0.f, 0.f, 0.f, -1.f};
  layout.tiles = {tile};
  const std::string text = faultsOf(layout);
  EXPECT_NE(text.find("first_tree = 5 should be 1"), std::string::npos) << text;
  EXPECT_NE(text.find("mix = -1 is outside"), std::string::npos) << text;
  EXPECT_NE(text.find("no positive weight"), std::string::npos) << text;
}

TEST(Layout, HashSeesEveryField) {
  const Layout layout = gridLayout(2, 5.0);
  std::set<std::uint64_t> hashes{layout.hash()};
  const auto differs = [&](auto change) {
    Layout other = layout;
    change(other);
    EXPECT_TRUE(hashes.insert(other.hash()).second);
  };
  differs([](Layout& l) { l.trees[0].yaw += 1e-12; });
  differs([](Layout& l) { l.trees[0].seed += 1; });
  differs([](Layout& l) { l.trees[0].position.z() += 1e-9; });
  differs([](Layout& l) { l.species[1].limbs[0].taper += 1e-12; });
  differs([](Layout& l) { l.motion.joint_model = JointModel::PAPER; });
  differs([](Layout& l) { l.terrain_hash = 7; });
}

// Trees of rows follow the single ones; a stage makes a young species of a grown one.
TEST(Layout, ReadsRowsAndStages) {
  Scenario scenario = Scenario::parse(
      "forest: {species: [{name: apple}, {name: young, file: ../species/apple.yaml, stage: 0.3}],"
      " trees: [{species: young}],"
      " rows: [{species: apple, origin: [5, 1, 0], heading: 1.5708, rows: 3, plants: 4, seed: 8},"
      " {species: young, rows: 1, plants: 2}]}",
      "rows.yaml");
  Faults faults;
  const Layout layout =
      readLayout(scenario.section("forest"), std::string(PACKAGE_FOLDER) + "/config/scenarios",
                 terrain::HeightMap(), 1, faults);
  EXPECT_EQ(faults.text() + scenario.faults().text(), "");
  ASSERT_EQ(layout.trees.size(), 1U + 12U + 2U);
  EXPECT_LT(layout.species[1].height, 0.5 * layout.species[0].height);
  EXPECT_EQ(layout.trees[4].species, 0);
  EXPECT_NEAR(layout.trees[4].position.x(), 5.0, 1e-4);
  EXPECT_NEAR(layout.trees[4].position.y(), 4.0, 1e-4);
  EXPECT_EQ(layout.trees[13].species, 1);
}

// S1-10: the factors of a tree scale stiffness, damping and load, and change nothing else.
TEST(Layout, ReadsFactorsOfSingleTrees) {
  Scenario scenario = Scenario::parse(
      "forest: {species: [{name: oak}, {name: birch}], trees: [{species: oak, seed: 5},"
      " {species: oak, seed: 5, stiffness: 0.5, damping: 2, wind: 3}, {species: birch},"
      " {species: oak, seed: 6, wind: 3, damping: 2, stiffness: 0.5},"
      " {species: birch, stiffness: 0.5, damping: 2, wind: 3}], tiles: [{count: 9, mix: {oak: "
      "1}}]}",
      "factors.yaml");
  Faults faults;
  const Layout layout =
      readLayout(scenario.section("forest"), std::string(PACKAGE_FOLDER) + "/config/scenarios",
                 terrain::HeightMap(), 1, faults);
  ASSERT_EQ(faults.text() + scenario.faults().text(), "");
  ASSERT_EQ(layout.species.size(), 4U);
  EXPECT_EQ(layout.species[2].name, "oak (stiffness 0.5, damping 2, wind 3)");
  EXPECT_EQ(layout.trees[0].species, 0);
  EXPECT_EQ(layout.trees[1].species, 2);
  EXPECT_EQ(layout.trees[3].species, 2);
  EXPECT_EQ(layout.trees[4].species, 3);
  for (std::uint32_t i = 0; i < 9; ++i) EXPECT_EQ(seedOf(layout, 5 + i).species, 0);
  const terrain::HeightMap flat;
  const Tree plain = growTree(layout, 0, flat), own = growTree(layout, 1, flat);
  ASSERT_EQ(plain.skeleton.hash(), own.skeleton.hash());
  const Wood a = woodOf(plain.skeleton, layout.species[0], Material::BEAM),
             b = woodOf(own.skeleton, layout.species[2], Material::BEAM);
  const Vec3 wind(4.0, 1.0, 0.0);
  for (std::size_t i = 0; i < a.stiffness.size(); ++i) {
    EXPECT_DOUBLE_EQ(b.stiffness[i], 0.5 * a.stiffness[i]);
    EXPECT_NEAR(b.damping[i], 2.0 * std::sqrt(0.5) * a.damping[i], 1e-9 * a.damping[i]);
    EXPECT_DOUBLE_EQ(b.own[i].drag, 3.0 * a.own[i].drag);
    EXPECT_EQ(b.own[i].mass, a.own[i].mass);
    EXPECT_NEAR(length(own.response[i].first), 6.0 * length(plain.response[i].first),
                1e-9 * length(own.response[i].first));
  }
}

class ScenarioFault : public testing::TestWithParam<std::pair<const char*, const char*>> {};
TEST_P(ScenarioFault, IsNamed) {
  Scenario scenario = Scenario::parse(GetParam().first, "bad.yaml");
  Faults faults;
  readLayout(scenario.section("forest"), std::string(PACKAGE_FOLDER) + "/config/scenarios",
             terrain::HeightMap(), 1, faults);
  const std::string text = faults.text() + scenario.faults().text();
  EXPECT_NE(text.find(GetParam().second), std::string::npos) << text;
}
INSTANTIATE_TEST_SUITE_P(
    Layout, ScenarioFault,
    testing::Values(
        std::pair("forest: {species: [{name: elm}]}", "elm.yaml: cannot be read"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: ash}]}",
                  "species = 'ash' is none of oak"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, scale: big}]}",
                  "scale = 'big' is not a number"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, scale: .nan}]}",
                  "scale = nan is not finite"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, colour: 1}]}",
                  "colour is not a known key"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, position: [1, 2]}]}",
                  "position has 2 numbers; 3 are expected"),
        std::pair("forest: {species: [{name: oak}], tiles: [{count: 99999999, mix: {oak: 1}}]}",
                  "count = 1e+08 is outside 0 to"),
        std::pair(
            "forest: {species: [{name: oak}], tiles: [{rows: 4096, columns: 4096, count: 1000,"
            " mix: {oak: 1}}]}",
            "4096 rows x 4096 columns x 1000 trees pass"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, yaw: 1, yaw: 2}]}",
                  "yaw is given twice"),
        std::pair("forest: {species: [{name: oak}, {name: oak}]}", "oak is given twice"),
        std::pair("forest: {species: [{name: oak, stage: 1.1}]}", "stage = 1.1 is outside 0 to 1"),
        std::pair("forest: {species: [{name: oak, strength: -1}]}",
                  "strength = -1 Pa is outside 0 to 1e+12 Pa"),
        std::pair("forest: {species: [{name: oak, strength: .nan}]}",
                  "strength = nan Pa is not finite"),
        std::pair("forest: {species: [{name: oak, strength: hard}]}",
                  "strength = 'hard' is not a number"),
        std::pair("forest: {species: [{name: oak}], rows: [{species: ash}]}",
                  "rows[0]: species = 'ash' is none of oak"),
        std::pair("forest: {species: [{name: oak}], rows: [{species: oak, gaps: 2}]}",
                  "rows[0]: gaps = 2 is outside 0 to 1"),
        std::pair("forest: {species: [{name: oak}], rows: [{species: oak, rows: 65536},"
                  " {species: oak, rows: 2}]}",
                  "rows[1]: has 2 plants in its rows; allowed are 0 to 0"),
        std::pair("forest: {species: [{name: oak}], motion: {drag: cubic}}",
                  "drag = 'cubic' is none of linear, quadratic"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, stiffness: 0}]}",
                  "trees[0]: stiffness = 0 is outside 0.01 to 100"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, damping: -1}]}",
                  "trees[0]: damping = -1 is outside 0 to 20"),
        std::pair("forest: {species: [{name: oak}], trees: [{species: oak, wind: .inf}]}",
                  "wind = inf is not finite"),
        std::pair("forest: {species: oak}", "species = 'oak' is not a list")));

}  // namespace
}  // namespace vegetation_sim::forest
