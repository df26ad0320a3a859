// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/skin.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

BatchPoses narrowed(const std::vector<Pose>& poses) {
  BatchPoses out;
  narrowPoses(poses, out);
  return out;
}

constexpr std::array<float, 3> FOOT{30.f, -20.f, 5.f};
constexpr double TOLERANCE = 2e-5;  // [m] single precision at 50 m

Vec3 point(const std::vector<float>& positions, std::size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

Vec3 foot() {
  return {FOOT[0], FOOT[1], FOOT[2]};
}

struct BentTree : testing::Test {
  BentTree() {
    const Layout layout = gridLayout(1, 10.0);
    tree = growTree(layout, 0, *flatTerrain());
    mesh = buildMesh(tree.skeleton, layout.species[0], meshDetail(GEOMETRY_LEVELS - 1));
    const wind::Field field({makeDisk(1, Vec3(2.0, 0.0, 0.0), 30.0, Vec3(14.0, 5.0, 0.0))});
    poses = poseBranches(tree, field.at(seconds(0.7)).relativeTo(tree.foot), fullWeights());
  }

  Vec3 footOf(const std::vector<float>& positions, std::size_t card) const;

  Tree tree;
  TreeMesh mesh;
  std::vector<Pose> poses;
};

// S1-08: skinning in single precision agrees with double precision.
TEST_F(BentTree, BarkFollowsItsBranches) {
  std::vector<float> positions(3 * mesh.bark.size()), normals(positions.size());
  skinBark(mesh, narrowed(poses), FOOT, positions.data());
  turnBarkNormals(mesh, narrowed(poses), normals.data());
  double bent = 0.0;
  for (std::size_t i = 0; i < mesh.bark.size(); ++i) {
    const BarkVertex& v = mesh.bark[i];
    const Pose& pose = poses[static_cast<std::size_t>(v.branch)];
    const Pose& rest = tree.skeleton.branches[static_cast<std::size_t>(v.branch)].rest;
    const Vec3 local(v.local[0], v.local[1], v.local[2]);
    const Vec3 expected = foot() + pose.position + rotate(pose.orientation, local);
    ASSERT_LT(length(point(positions, i) - expected), TOLERANCE) << i;
    EXPECT_NEAR(length(point(normals, i)), 1.0, 1e-5);
    bent = std::max(bent, length(pose.position - rest.position));
  }
  EXPECT_GT(bent, 0.05);  // the wind does bend this tree
}

TEST_F(BentTree, LeafCardsLieInSquaresOnTheirBranches) {
  std::vector<float> positions(3 * LEAF_CORNERS * mesh.leaves.size());
  skinLeaves(mesh, narrowed(poses), FOOT, Flutter(), positions.data());
  for (std::size_t i = 0; i < mesh.leaves.size(); ++i) {
    const LeafCard& leaf = mesh.leaves[i];
    const Pose& pose = poses[static_cast<std::size_t>(leaf.branch)];
    const Vec3 at = foot() + pose.position +
                    rotate(pose.orientation, Vec3(leaf.local[0], leaf.local[1], leaf.local[2]));
    const Quat turn = pose.orientation *
                      Quat{leaf.rotation[0], leaf.rotation[1], leaf.rotation[2], leaf.rotation[3]};
    for (std::size_t c = 0; c < LEAF_CORNERS; ++c) {
      const LeafOutline& outline = mesh.outlineOf(i);
      const Vec3 in_square(outline[c][0] - 0.5f, outline[c][1], 0.0);
      const Vec3 expected = at + static_cast<double>(leaf.size) * rotate(turn, in_square);
      ASSERT_LT(length(point(positions, 4 * i + c) - expected), 2.0 * TOLERANCE);
    }
  }
}

// Returns the foot of the midrib from three corners of a card.
Vec3 BentTree::footOf(const std::vector<float>& positions, std::size_t card) const {
  const auto corner = [&](std::size_t c) {
    return Vec3(mesh.outlineOf(card)[c][0] - 0.5f, mesh.outlineOf(card)[c][1], 0.0);
  };
  const Vec3 a = corner(0), u = corner(1) - a, v = corner(2) - a;
  const double area = u.x() * v.y() - u.y() * v.x();
  const double along_u = (a.y() * v.x() - a.x() * v.y()) / area;
  const double along_v = (a.x() * u.y() - a.y() * u.x()) / area;
  const Vec3 at = point(positions, 4 * card);
  return at + along_u * (point(positions, 4 * card + 1) - at) +
         along_v * (point(positions, 4 * card + 2) - at);
}

// S1-W5: flutter rotates the cards by at most its angle and keeps their feet in place.
TEST_F(BentTree, FlutterTurnsLeavesAboutTheirFeet) {
  std::vector<float> still(3 * LEAF_CORNERS * mesh.leaves.size()), moved(still.size());
  const BatchPoses narrow = narrowed(poses);
  skinLeaves(mesh, narrow, FOOT, Flutter(), still.data());
  skinLeaves(mesh, narrow, FOOT, Flutter(12.3, 8.0, 0.2), moved.data());
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.leaves.size(); ++i) {
    ASSERT_LT(length(footOf(moved, i) - footOf(still, i)), 4.0 * TOLERANCE);
    const double way = length(point(moved, 4 * i + 2) - point(still, 4 * i + 2));
    ASSERT_LT(way, 0.2 * 1.6 * static_cast<double>(mesh.leaves[i].size));
    largest = std::max(largest, way);
  }
  EXPECT_GT(largest, 0.02);
}

}  // namespace
}  // namespace vegetation_sim::forest
