// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/skeleton.h"

#include <gtest/gtest.h>

#include <set>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

Skeleton growShipped(const std::string& name, std::uint64_t seed) {
  TreeSeed tree;
  tree.seed = seed;
  return grow(tree, shippedSpecies(name));
}

class SkeletonOfSpecies : public testing::TestWithParam<std::string> {};

// S1-07: h along the parent's z, theta about it, then phi about the child's y.
TEST(Skeleton, ChildIsPlacedAsInFigureOne) {
  const Quat child = restRotation(PI / 2.0, PI / 2.0);
  EXPECT_NEAR(axisZ(child).y(), 1.0, 1e-15);  // axis = +y of the parent
  EXPECT_NEAR(length(axisZ(child) - Vec3(0, 1, 0)), 0.0, 1e-15);
  // Every branch of a tree follows the same rule: its rest pose is that of its parent by (h, theta,
  // phi).
  const Skeleton skeleton = growShipped("oak", 3);
  for (const Branch& b : skeleton.branches) {
    if (b.parent < 0) continue;
    const Pose& parent = skeleton.branches[static_cast<std::size_t>(b.parent)].rest;
    const Vec3 base = parent.position + b.h * axisZ(parent.orientation);
    EXPECT_NEAR(length(base - b.rest.position), 0.0, 1e-12);
    const SinCos t = sinCos(b.theta), p = sinCos(b.phi);
    const Vec3 axis = rotate(parent.orientation, Vec3(t.cos * p.sin, t.sin * p.sin, p.cos));
    EXPECT_NEAR(length(axis - axisZ(b.rest.orientation)), 0.0, 1e-12);
  }
}

// S1-04: a tree rebuilt from its seed has the same bits.
TEST_P(SkeletonOfSpecies, RegrowsBitIdentical) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_EQ(growShipped(GetParam(), seed).hash(), growShipped(GetParam(), seed).hash());
}

TEST_P(SkeletonOfSpecies, IsCountedWithoutBeingGrown) {
  const Species species = shippedSpecies(GetParam());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TreeSeed tree;
    tree.seed = seed;
    EXPECT_EQ(countBranches(tree, species), grow(tree, species).branches.size()) << seed;
  }
}

// S1-06
TEST_P(SkeletonOfSpecies, SeedsGiveDifferentTrees) {
  std::set<std::uint64_t> hashes;
  for (std::uint64_t seed = 0; seed < 64; ++seed)
    hashes.insert(growShipped(GetParam(), seed).hash());
  EXPECT_EQ(hashes.size(), 64u);
}

// S1-02 asks for trees worth animating: at least 200 branches each.
TEST_P(SkeletonOfSpecies, HasAtLeastTwoHundredBranches) {
  for (std::uint64_t seed = 0; seed < 64; ++seed)
    EXPECT_GE(growShipped(GetParam(), seed).branches.size(), 200u) << seed;
}

// S1-11: the bound holds for every joint and falls with the relative diameter.
TEST_P(SkeletonOfSpecies, AngleIsBoundedByRelativeDiameter) {
  const Species species = shippedSpecies(GetParam());
  for (double ratio = 0.0; ratio < 1.0; ratio += 0.1)
    EXPECT_GT(largestAngle(species, ratio), largestAngle(species, ratio + 0.1));
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Skeleton skeleton = growShipped(GetParam(), seed);
    for (const Branch& b : skeleton.branches) {
      if (b.parent < 0) continue;
      const Branch& parent = skeleton.branches[static_cast<std::size_t>(b.parent)];
      const double f = b.h / parent.length;
      const double bearer = parent.base_radius + (parent.tip_radius - parent.base_radius) * f;
      EXPECT_LE(b.phi, largestAngle(species, b.base_radius / bearer) + 1e-9);
      EXPECT_LE(b.base_radius, bearer * (1.0 + 1e-12));
    }
  }
}

TEST_P(SkeletonOfSpecies, GroupsHoldNoParentOfTheirOwn) {
  const Skeleton skeleton = growShipped(GetParam(), 5);
  int end = 0;
  for (const Group& group : skeleton.groups) {
    EXPECT_EQ(group.begin, end);
    end = group.end;
    for (int i = group.begin; i < group.end; ++i) {
      const Branch& b = skeleton.branches[static_cast<std::size_t>(i)];
      EXPECT_LT(b.parent, group.begin);
      EXPECT_EQ(b.depth, group.depth);
      if (b.next >= 0) {
        EXPECT_EQ(skeleton.branches[static_cast<std::size_t>(b.next)].parent, i);
      }
    }
  }
  EXPECT_EQ(end, static_cast<int>(skeleton.branches.size()));
  EXPECT_EQ(skeleton.depth_end.back(), end);
}

TEST_P(SkeletonOfSpecies, LimbsTaperWithoutSteps) {
  const Skeleton skeleton = growShipped(GetParam(), 5);
  for (const Branch& b : skeleton.branches) {
    EXPECT_LE(b.tip_radius, b.base_radius);
    if (b.next < 0) continue;
    EXPECT_NEAR(skeleton.branches[static_cast<std::size_t>(b.next)].base_radius, b.tip_radius,
                1e-12);
  }
}

// S1-12: amplitude 0 leaves the bare rules for any seed; more noise makes more difference.
TEST_P(SkeletonOfSpecies, NoNoiseLeavesTheBareRules) {
  Species species = shippedSpecies(GetParam());
  species.noise = 0.0;
  TreeSeed a, b;
  a.seed = 1;
  b.seed = 2;
  const Skeleton first = grow(a, species), second = grow(b, species);
  EXPECT_EQ(first.hash(), second.hash());
  EXPECT_DOUBLE_EQ(first.branches[0].length * species.limbs[0].segments, species.height);
  for (const Branch& branch : first.branches) {
    if (branch.depth == 1 && branch.h > 0.0 &&
        first.branches[static_cast<std::size_t>(branch.parent)].depth == 0) {
      EXPECT_GE(branch.phi,
                std::min(species.limbs[1].angle_low, species.limbs[1].angle_high) - 1e-9);
    }
  }
  species.noise = 1.0;
  EXPECT_NE(grow(a, species).hash(), first.hash());
}

INSTANTIATE_TEST_SUITE_P(Shipped, SkeletonOfSpecies, testing::ValuesIn(speciesNames()));

TEST(Skeleton, SeedMovesAndScalesTheTree) {
  const Species species = shippedSpecies("oak");
  TreeSeed seed;
  seed.seed = 9;
  const Skeleton one = grow(seed, species);
  seed.scale = 2.0;
  const Skeleton two = grow(seed, species);
  ASSERT_EQ(one.branches.size(), two.branches.size());
  EXPECT_NEAR(two.height / one.height, 2.0, 0.02);  // thinnest twigs do not scale
}

}  // namespace
}  // namespace vegetation_sim::forest
