// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/limb_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::view {
namespace {

using forest::BarkVertex;
using forest::Skeleton;
using forest::TreeMesh;

const forest::MeshDetail NEAR = forest::meshDetail(forest::GEOMETRY_LEVELS - 1);

Skeleton growOak() {
  forest::TreeSeed seed;
  seed.seed = 3;
  return forest::grow(seed, forest::shippedSpecies("oak"));
}

TreeMesh meshOf(const Skeleton& skeleton) {
  return forest::buildMesh(skeleton, forest::shippedSpecies("oak"), NEAR);
}

double radiusOf(const BarkVertex& vertex) {
  return std::hypot(static_cast<double>(vertex.local[0]), static_cast<double>(vertex.local[1]));
}

bool isAtEnd(const Skeleton& skeleton, const BarkVertex& vertex) {
  const forest::Branch& branch = skeleton.branches[static_cast<std::size_t>(vertex.branch)];
  return branch.next < 0 && vertex.local[2] == forest::narrow(branch.length);
}

/// Returns the second branch of a limb.
int secondOfALimb(const Skeleton& skeleton) {
  for (std::size_t i = 1; i < skeleton.branches.size(); ++i) {
    const forest::Branch& branch = skeleton.branches[i];
    if (branch.depth == 1 && branch.next >= 0) return branch.next;
  }
  return -1;
}

// Only the rings at the tips become narrower, and no triangle is added.
TEST(LimbEnds, LimbsEndInAPoint) {
  const Skeleton skeleton = growOak();
  const TreeMesh before = meshOf(skeleton);
  TreeMesh after = before;
  finishLimbEnds(skeleton, after);
  ASSERT_EQ(after.bark.size(), before.bark.size());
  EXPECT_EQ(after.triangles, before.triangles);
  int tips = 0;
  for (std::size_t i = 0; i < before.bark.size(); ++i) {
    const double share = radiusOf(after.bark[i]) / radiusOf(before.bark[i]);
    if (isAtEnd(skeleton, before.bark[i])) {
      EXPECT_LT(share, 0.2);
      ++tips;
    } else {
      EXPECT_EQ(share, 1.0);
    }
  }
  EXPECT_GT(tips, 100);
}

// A limb keeps its radius where it broke and has a cap there that bulges outwards.
TEST(LimbEnds, ABrokenLimbEndsInACap) {
  Skeleton skeleton = growOak();
  forest::BrokenBranch piece;
  piece.branch = secondOfALimb(skeleton);
  ASSERT_GT(piece.branch, 0);
  const int stump = skeleton.branches[static_cast<std::size_t>(piece.branch)].parent;
  forest::breakOff({piece}, skeleton);
  const TreeMesh before = meshOf(skeleton);
  TreeMesh after = before;
  finishLimbEnds(skeleton, after);
  ASSERT_EQ(after.bark.size(), before.bark.size() + 1);
  const BarkVertex& middle = after.bark.back();
  const forest::Branch& branch = skeleton.branches[static_cast<std::size_t>(stump)];
  EXPECT_EQ(middle.branch, stump);
  EXPECT_EQ(radiusOf(middle), 0.0);
  EXPECT_GT(middle.local[2], forest::narrow(branch.length));
  std::size_t rim = 0;
  for (std::size_t i = 0; i < before.bark.size(); ++i) {
    if (before.bark[i].branch != stump || !isAtEnd(skeleton, before.bark[i])) continue;
    EXPECT_EQ(radiusOf(after.bark[i]), radiusOf(before.bark[i]));
    ++rim;
  }
  EXPECT_EQ(after.triangles.size(), before.triangles.size() + 3 * (rim - 1));
}

}  // namespace
}  // namespace vegetation_sim::view
