// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/octomap_writer.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <sstream>

#include "scenes/forest/forest_fixture.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

/// Three oaks in a tile on a slope and one beside it.
Layout layoutOnSlope() {
  Layout out = gridLayout(1, 5.0);
  out.trees[0].position = Vec3(3, 3, 0);
  Tile tile;
  tile.first_tree = 1;
  tile.count = 3;
  tile.x = tile.y = 10.0;
  tile.size = 14.0;
  tile.seed = 3;
  tile.mix.assign(out.species.size(), 1.f);
  out.tiles = {tile};
  return out;
}

std::string octomapOf(const Layout& layout, const terrain::HeightMap& terrain,
                      const OctomapRule& rule) {
  std::ostringstream out;
  EXPECT_GT(writeOctomap(layout, terrain, rule, out), 100u);
  return out.str();
}

// N14: the library of OctoMap reads the wood where the branches are, on a slope and in tiles.
TEST(OctomapWriter, CellsThatWoodTouchesAreOccupiedAndNoneFarFromIt) {
  const Layout layout = layoutOnSlope();
  const terrain::HeightMap ground = grass::slopedGround(0.3, -0.1);
  for (const double resolution : {0.05, 0.2}) {
    std::istringstream in(octomapOf(layout, ground, {resolution, 0.03}));
    octomap::OcTree octree(resolution);
    ASSERT_TRUE(octree.readBinary(in));
    EXPECT_DOUBLE_EQ(octree.getResolution(), resolution);
    int inside = 0, missing = 0;
    std::vector<Branch> branches;
    for (std::uint32_t id = 0; id < layout.treeCount(); ++id) {
      const Tree tree = growTree(layout, id, ground);
      for (std::size_t i = 0; i < tree.skeleton.branches.size(); ++i) {
        Branch branch = tree.skeleton.branches[i];
        if (i > 0 && branch.base_radius < 0.03) continue;
        branch.rest.position += tree.foot;
        branches.push_back(branch);
        const Vec3 side = rotate(branch.rest.orientation, Vec3::UnitX());
        for (const double part : {0.0, 0.3, 0.7, 1.0})
          for (const double out : {-0.99, 0.0, 0.99}) {
            const double radius =
                branch.base_radius + part * (branch.tip_radius - branch.base_radius);
            const Vec3 at = branch.rest.position +
                            part * branch.length * axisZ(branch.rest.orientation) +
                            out * radius * side;
            ++inside;
            const octomap::OcTreeNode* node = octree.search(at.x(), at.y(), at.z());
            missing += !node || !octree.isNodeOccupied(node);
          }
      }
    }
    EXPECT_GT(inside, 500);
    EXPECT_EQ(missing, 0) << resolution;
    double farthest = 0.0;
    octree.expand();
    for (auto leaf = octree.begin_leafs(); leaf != octree.end_leafs(); ++leaf) {
      const Vec3 middle(leaf.getX(), leaf.getY(), leaf.getZ());
      double beyond = 1e9;
      for (const Branch& branch : branches) {
        const Vec3 axis = axisZ(branch.rest.orientation);
        const double along =
            std::clamp(dot(middle - branch.rest.position, axis), 0.0, branch.length);
        const double radius =
            branch.base_radius + along / branch.length * (branch.tip_radius - branch.base_radius);
        beyond = std::min(beyond, length(middle - branch.rest.position - along * axis) - radius);
      }
      farthest = std::max(farthest, beyond);
    }
    EXPECT_LE(farthest, 0.88 * resolution);
  }
}

TEST(OctomapWriter, RefusesCellsThatAreTooManyTooSmallOrTooFar) {
  for (const double resolution : {0.0, 0.001, 11.0, std::nan("")}) {
    Faults faults;
    check(OctomapRule{resolution, 0.05}, faults);
    EXPECT_NE(faults.text().find("resolution"), std::string::npos) << resolution;
  }
  const auto reason = [](const Layout& layout, const OctomapRule& rule) -> std::string {
    std::ostringstream out;
    try {
      writeOctomap(layout, *flatTerrain(), rule, out);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(reason(gridLayout(1, 5.0), {0.05, 0.01, 1000}).find("more than 1000 cells"),
            std::string::npos);
  Layout far = gridLayout(1, 5.0);
  far.trees[0].position = Vec3(2000, 0, 0);
  EXPECT_NE(reason(far, {0.05, 0.01}).find("1638.4"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::forest
