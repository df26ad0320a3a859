// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/drawn_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/forest/physics_scene.h"
#include "tree/mesh/paint.h"

namespace vegetation_sim::view {
namespace {

using forest::PhysicsRig;

/// A forest with a branch that is pulled, and a replica that draws it.
struct RegisteredViewer {
  PhysicsRig rig;
  forest::ForestReplica replica;
  int branch{0};

  RegisteredViewer() {
    rig.forest.setWind(forest::steadyWind(Vec3(1, 0, 0)));
    rig.run(0.5);
    branch = rig.branchOfDepth(1);
    replica.setLayout(rig.forest.layout(), forest::flatTerrain());
    replica.setWind(rig.forest.snapshot().wind);
    update(true);
  }
  void update(bool key_frame) { ASSERT_TRUE(replica.apply(rig.forest.update(key_frame))); }
  void run(double duration) {
    rig.run(duration, [&] { update(false); });
  }
  bool move(DrawnTree& tree) {
    const wind::Instant wind = rig.forest.snapshot().wind.at(rig.now());
    return tree.move(replica, rig.now(), wind, TreeLook(), 1.0);
  }
  /// Returns the distance from the branch's tip in the forest to the nearest vertex of bark.
  double distanceAtTip(const DrawnTree& tree) const {
    const Vec3 tip = rig.tip(branch);
    double nearest = 1e9;
    const std::vector<float>& at = tree.shapes().front().bark.positions;
    for (std::size_t i = 0; i < at.size(); i += 3)
      nearest = std::min(nearest, length(tree.origin() + Vec3(at[i], at[i + 1], at[i + 2]) - tip));
    return nearest;
  }
};

// S1-35: the branch is drawn in its physical pose, not in the pose of the wind alone.
TEST(DrawnTree, PhysicalBranchesAreDrawnWhereTheForestHasThem) {
  RegisteredViewer viewer;
  DrawnTree tree(viewer.replica, 0, Vec3::Zero());
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}},
                 forest::LightGrid(Vec3(-9, -9, -1), Vec3(9, 9, 12), 1.0), TreeLook());
  ASSERT_TRUE(viewer.move(tree));
  const double radius = viewer.rig.branches()[viewer.branch].tip_radius;
  EXPECT_LT(viewer.distanceAtTip(tree), 1.5 * radius);
  const Vec3 calm = viewer.rig.tip(viewer.branch);
  forest::Grab grab = viewer.rig.grabOf(viewer.branch);
  grab.target += Vec3(0.0, 0.5, -0.2);
  const std::uint32_t id = viewer.rig.forest.addGrab(grab);
  viewer.run(1.0);
  ASSERT_GT(length(viewer.rig.tip(viewer.branch) - calm), 5.0 * radius);
  EXPECT_GT(viewer.distanceAtTip(tree), 1.5 * radius);  // It has not moved yet.
  ASSERT_TRUE(viewer.move(tree));
  EXPECT_LT(viewer.distanceAtTip(tree), 1.5 * radius);
  viewer.rig.forest.release(id);
  viewer.run(10.0);
  ASSERT_TRUE(viewer.replica.promoted(0).branches.empty());
  ASSERT_TRUE(viewer.move(tree));
  EXPECT_LT(viewer.distanceAtTip(tree), 1.5 * radius);
}

// A limb that is cut falls: the tree is drawn without it, and the piece lower and lower, until it
// lies.
TEST(DrawnTree, APieceFallsBesideItsTree) {
  RegisteredViewer viewer;
  const forest::LightGrid light(Vec3(-9, -9, -1), Vec3(9, 9, 12), 1.0);
  DrawnTree tree(viewer.replica, 0, Vec3::Zero());
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}}, light, TreeLook());
  const std::size_t whole = tree.triangleCount();
  EXPECT_FALSE(tree.isOutdated(viewer.replica));
  viewer.rig.forest.cut({0, viewer.rig.tree.skeleton.depth_end[0]});
  viewer.run(1.0 / forest::TICK_RATE);
  EXPECT_TRUE(tree.isOutdated(viewer.replica));
  tree.regrow(viewer.replica);
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}}, light, TreeLook());
  EXPECT_FALSE(tree.isOutdated(viewer.replica));
  EXPECT_LT(tree.triangleCount(), whole);

  const auto& broken = brokenOf(viewer.replica.broken(), 0);
  ASSERT_EQ(broken.size(), 1u);
  const auto falling = std::make_shared<const forest::FallingPiece>(
      viewer.replica.layout(), viewer.replica.terrain(), 0, broken, 0);
  DrawnTree piece(viewer.replica, 0, Vec3::Zero(), falling);
  EXPECT_TRUE(piece.isPiece(broken.front()));
  piece.setLevels({forest::GEOMETRY_LEVELS - 1, {}}, light, TreeLook());
  // A cap closes the foot of the piece.
  EXPECT_GT(tree.triangleCount() + piece.triangleCount(), whole);
  EXPECT_LT(tree.triangleCount() + piece.triangleCount(), whole + 16);
  const auto lowest = [&] {
    double out = 1e9;
    const std::vector<float>& at = piece.shapes().front().bark.positions;
    for (std::size_t i = 2; i < at.size(); i += 3) out = std::min(out, static_cast<double>(at[i]));
    return out;
  };
  ASSERT_TRUE(viewer.move(piece));
  const double start = lowest();
  viewer.run(0.2);
  ASSERT_TRUE(viewer.move(piece));
  EXPECT_NEAR(lowest(), start - 0.5 * 9.81 * 0.04, 0.02);
  viewer.run(3.0);
  ASSERT_TRUE(viewer.move(piece));
  EXPECT_NEAR(lowest(), 0.0, 0.05);  // wood has a thickness around its axis
  EXPECT_FALSE(viewer.move(piece));
}

// Limbs differ in lightness, and leaves inside a crown are darker than at its edge.
TEST(DrawnTree, LimbsAndTheEdgeOfACrownStandOut) {
  RegisteredViewer viewer;
  DrawnTree tree(viewer.replica, 0, Vec3::Zero());
  tree.setLevels({forest::GEOMETRY_LEVELS - 1, {}},
                 forest::LightGrid(Vec3(-9, -9, -1), Vec3(9, 9, 12), 1.0), TreeLook());
  const forest::Tree& source = viewer.rig.tree;
  const forest::TreePaint plain(viewer.replica.layout().species.at(source.seed.species),
                                source.seed.seed);
  const DrawnTree::Shape& shape = tree.shapes().front();
  std::vector<double> lightness;
  for (std::size_t card = 0; card < shape.mesh.leaves.size(); ++card) {
    const auto green = static_cast<double>(plain.leaf(shape.mesh.leaves[card])[1]);
    lightness.push_back(shape.leaves.paint[4 * card].colour[1] / (255.0 * green));
  }
  ASSERT_GT(lightness.size(), 100u);
  std::sort(lightness.begin(), lightness.end());
  EXPECT_LT(lightness[lightness.size() / 20], 0.95);
  EXPECT_GT(lightness[lightness.size() - lightness.size() / 20], 1.08);
}

}  // namespace
}  // namespace vegetation_sim::view
