// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "scenes/forest/forest_fixture.h"
#include "scenes/grass/grass_fixture.h"

namespace vegetation_sim::forest {
namespace {

// Returns the numbers of the first group of every match.
std::vector<std::vector<double>> numbersOf(const std::string& text, const std::string& pattern) {
  std::vector<std::vector<double>> out;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) {
    std::istringstream words((*i)[1].str());
    out.emplace_back();
    for (double value = 0.0; words >> value;) out.back().push_back(value);
  }
  return out;
}

std::string sdfOf(const Layout& layout, const ExportRule& rule) {
  std::ostringstream out;
  writeSdf(layout, *flatTerrain(), rule, out);
  return out.str();
}

// N14: trunks stand where the layout has them.
TEST(Export, LinksStandAtTheFeetOfTheTrees) {
  const Layout layout = gridLayout(3, 7.0);
  const auto links = numbersOf(sdfOf(layout, {}), "<link name=\"tree_[0-9]+\"><pose>([^<]*)<");
  ASSERT_EQ(links.size(), layout.trees.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const Vec3 foot = footOf(layout.trees[i], *flatTerrain());
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(links[i][axis], foot[axis], 1e-7) << i;
  }
}

// N14: on a slope, trees of the list and of tiles stand on the ground, and
// their cylinders with them.
TEST(Export, OnASlopeTreesOfTilesStandOnTheGround) {
  const terrain::HeightMap ground = grass::slopedGround(0.3, -0.1);
  Layout layout = gridLayout(2, 7.0);
  for (std::uint32_t i = 0; i < 2; ++i)
    layout.tiles.push_back({4 + 5 * i, 5, 4 + i, 16.0 + 6.0 * i, 2.0, 6.0, {1.f, 0.f, 2.f, 0.f}});
  std::ostringstream sdf, table;
  writeSdf(layout, ground, {}, sdf);
  const auto links = numbersOf(sdf.str(), "<link name=\"tree_[0-9]+\"><pose>([^<]*)<");
  ASSERT_EQ(links.size(), 14u);
  writeTable(layout, ground, table);
  std::istringstream lines(table.str());
  std::string line;
  std::getline(lines, line);
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const Tree tree = growTree(layout, i, ground);
    const std::vector<double>& at = links[i];
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(at[axis], tree.foot[axis], 1e-7) << i;
    EXPECT_NEAR(at[2], ground.height(at[0], at[1]), 1e-6) << i;
    EXPECT_TRUE(i < 4 || (at[0] >= 16.0 && at[0] <= 28.0 && at[1] >= 2.0 && at[1] <= 8.0)) << i;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.rfind(std::to_string(i) + ",", 0), 0u);
  }
  EXPECT_GT(std::abs(links[13][2] - links[0][2]), 1.0);
}

// N14: each cylinder goes from the base of its branch to its tip at any inclination.
TEST(Export, CylindersLieOnTheirBranches) {
  Layout layout = gridLayout(1, 1.0);
  ExportRule rule;
  rule.thinnest = 0.001;
  const std::string sdf = sdfOf(layout, rule);
  const auto poses = numbersOf(sdf, "<collision name=\"[a-z_0-9]+\"><pose>([^<]*)<");
  const auto lengths = numbersOf(sdf, "<length>([^<]*)</length></cylinder></geometry></collision");
  const Skeleton skeleton = grow(layout.trees[0], layout.species[0]);
  ASSERT_EQ(poses.size(), skeleton.branches.size());
  ASSERT_EQ(lengths.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& branch = skeleton.branches[i];
    const std::vector<double>& p = poses[i];
    ASSERT_EQ(p.size(), 6u);
    const double half = 0.5 * lengths[i][0];
    const Vec3 axis(std::sin(p[4]) * std::cos(p[5]), std::sin(p[4]) * std::sin(p[5]),
                    std::cos(p[4]));
    const Vec3 middle(p[0], p[1], p[2]);
    EXPECT_LT(length(middle - half * axis - branch.rest.position), 1e-6) << i;
    EXPECT_LT(length(middle + half * axis - tipOf(branch, branch.rest)), 1e-6) << i;
  }
}

// N14: the mesh has the samples of the ground, or fewer of them.
TEST(Export, GroundIsAMeshThroughItsSamples) {
  const terrain::HeightMap ground = grass::slopedGround(0.3, -0.1);
  std::ostringstream sdf;
  writeSdf(gridLayout(1, 7.0), ground, {}, sdf);
  EXPECT_NE(sdf.str().find("<uri>model://forest/terrain.obj</uri>"), std::string::npos);
  EXPECT_EQ(sdfOf(gridLayout(1, 7.0), {}).find("terrain"), std::string::npos);
  for (const std::uint64_t most : {2000u, 500u, 10u}) {
    std::ostringstream out;
    const double step = writeTerrain(ground, most, out);
    const auto vertices = numbersOf(out.str(), "v ([^\n]*)\n");
    const auto facets = numbersOf(out.str(), "f ([^\n]*)\n");
    EXPECT_EQ(step, most == 2000 ? 1.0 : most == 500 ? 2.0 : 16.0);
    const auto side = static_cast<std::size_t>(32.0 / step) + 1;
    EXPECT_EQ(vertices.back(), (std::vector<double>{32.0, 32.0, vertices.back()[2]}));
    ASSERT_EQ(vertices.size(), side * side);
    ASSERT_EQ(facets.size(), 2 * (side - 1) * (side - 1));
    for (const auto& v : vertices) EXPECT_NEAR(v[2], ground.height(v[0], v[1]), 1e-7);
    for (const auto& f : facets) {
      const auto corner = [&](int i) {
        const auto& v = vertices.at(static_cast<std::size_t>(f[std::size_t(i)]) - 1);
        return Vec3(v[0], v[1], 0.0);
      };
      EXPECT_NEAR((corner(1) - corner(0)).cross(corner(2) - corner(0)).z(), step * step, 1e-6);
    }
  }
}

TEST(Export, ThinWoodIsLeftOutAndTrunksNever) {
  const Layout layout = gridLayout(2, 5.0);
  ExportRule thick, all;
  thick.thinnest = 10.0;
  all.thinnest = 0.001;
  std::ostringstream none, every;
  EXPECT_EQ(writeSdf(layout, *flatTerrain(), thick, none), layout.trees.size());
  EXPECT_GT(writeSdf(layout, *flatTerrain(), all, every), 100u);
}

TEST(Export, TableHasALineATree) {
  const Layout layout = gridLayout(2, 5.0);
  std::ostringstream out;
  writeTable(layout, *flatTerrain(), out);
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "tree,species,x,y,z,trunk_radius,height");
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("0,oak,0,0,0,", 0), 0u) << line;
  int more = 0;
  while (std::getline(lines, line)) ++more;
  EXPECT_EQ(more, 3);
}

TEST(Export, NamesInTheTableAreQuotedWhereTheyMustBe) {
  Layout layout = gridLayout(1, 5.0);
  layout.species[0].name = "oak, the \"old\" one";
  std::ostringstream out;
  writeTable(layout, *flatTerrain(), out);
  EXPECT_NE(out.str().find("\n0,\"oak, the \"\"old\"\" one\",0,0,0,"), std::string::npos)
      << out.str();
}

TEST(Export, RefusesWhatWouldNotBeLoaded) {
  for (const double thinnest : {0.0, -1.0, 11.0, std::nan("")}) {
    Faults faults;
    check(ExportRule{"forest", thinnest, 10}, faults);
    EXPECT_NE(faults.text().find("thinnest"), std::string::npos) << thinnest;
  }
  Faults faults;
  check(ExportRule{"a<b", 0.05, 10}, faults);
  EXPECT_NE(faults.text().find("'a<b'"), std::string::npos);
  ExportRule few;
  few.thinnest = 0.001;
  few.most_branches = 20;
  EXPECT_THROW(sdfOf(gridLayout(2, 5.0), few), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim::forest
