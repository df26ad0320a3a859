// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/bough_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <vector>

#include "scenes/forest/forest_fixture.h"
#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::forest {
namespace {

const Species& oak() {
  static const Species species = shippedSpecies("oak");
  return species;
}

const Skeleton& tree() {
  static const Skeleton skeleton = grow(TreeSeed(), oak());
  return skeleton;
}

Viewpoint eyeAt(double distance) {
  Viewpoint out;
  out.position = Vec3(distance, 0.0, 0.5 * tree().height);
  return out;
}

constexpr double FACTOR = 0.25;  // on sizes, as 80 000 triangles in a wood of 1000 trees ask for

TreeLevels levelsFrom(double distance, bool by_bough, const TreeLevels& current = {}) {
  return treeLevels(tree(), Boughs(tree()), Vec3::Zero(), eyeAt(distance), FACTOR, by_bough,
                    current);
}

std::size_t trianglesOf(const TreeLevels& levels) {
  return buildMesh(tree(), oak(), treeMeshDetail(Boughs(tree()), levels)).triangleCount();
}

/// What a mesh has of one bough: by branch, vertices of bark, and keys of cards.
struct Part {
  std::size_t bark{0};
  std::vector<std::uint32_t> cards;
};
bool operator==(const Part& a, const Part& b) {
  return a.bark == b.bark && a.cards == b.cards;
}

// The bark of the trunk has the key -1; cards that a bough has on the trunk are counted there.
std::map<int, Part> partsOf(const TreeMesh& mesh, const Boughs& boughs) {
  std::map<int, Part> out;
  for (const BarkVertex& vertex : mesh.bark)
    ++out[boughs.ofBranches()[static_cast<std::size_t>(vertex.branch)]].bark;
  for (const LeafCard& card : mesh.leaves)
    out[boughs.ofBranches()[static_cast<std::size_t>(card.branch)]].cards.push_back(card.key);
  for (auto& entry : out) std::sort(entry.second.cards.begin(), entry.second.cards.end());
  return out;
}

TEST(Boughs, EachBranchButTheTrunkBelongsToTheLimbThatCarriesIt) {
  const Boughs boughs(tree());
  ASSERT_EQ(boughs.ofBranches().size(), tree().branches.size());
  std::size_t limbs = 0;
  for (std::size_t i = 0; i < tree().branches.size(); ++i) {
    const Branch& branch = tree().branches[i];
    const int bough = boughs.ofBranches()[i];
    EXPECT_EQ(bough < 0, branch.depth == 0);
    if (bough < 0) continue;
    const Branch& parent = tree().branches[static_cast<std::size_t>(branch.parent)];
    if (parent.depth == 0)
      EXPECT_EQ(bough, static_cast<int>(limbs++));
    else
      EXPECT_EQ(bough, boughs.ofBranches()[static_cast<std::size_t>(branch.parent)]);
    const Vec3 tip = tipOf(branch, branch.rest);
    EXPECT_LT(boughs.distanceTo(static_cast<std::size_t>(bough), tip), 1e-9);
  }
  EXPECT_EQ(boughs.size(), limbs);
  EXPECT_GT(limbs, 5u);
}

// S1-13: by the projected size of the branch's own part of the tree.
TEST(TreeLevels, BoughsHaveTheLevelOfATreeAtTheirDistance) {
  const Boughs boughs(tree());
  for (const double distance : {6.0, 7.0, 8.0, 10.0}) {
    const TreeLevels levels = levelsFrom(distance, true);
    ASSERT_EQ(levels.boughs.size(), boughs.size());
    for (std::size_t i = 0; i < boughs.size(); ++i) {
      const Viewpoint eye = eyeAt(distance);
      const double size =
          FACTOR * pixelsPerMetre(eye, boughs.distanceTo(i, eye.position)) * tree().height;
      EXPECT_EQ(levels.boughs[i], std::min(levels.trunk, geometryLevel(size, -1))) << distance;
    }
  }
}

TEST(TreeLevels, FarTreesAndThoseWithoutThePropertyHaveOneLevel) {
  int with_boughs = 0;
  for (double distance = 1.0; distance < 100.0; distance *= 1.1) {
    EXPECT_TRUE(levelsFrom(distance, false).boughs.empty());
    const TreeLevels levels = levelsFrom(distance, true);
    EXPECT_EQ(levels.trunk, levelsFrom(distance, false).trunk);
    EXPECT_TRUE(distance < DISTANCE_OF_BOUGHS * tree().reach || levels.boughs.empty()) << distance;
    with_boughs += levels.boughs.empty() ? 0 : 1;
  }
  EXPECT_GT(with_boughs, 5);
}

TEST(TreeLevels, DoNotFlickerAtBorders) {
  TreeLevels levels = levelsFrom(6.0, true);
  int changes = 0;
  for (int i = 0; i < 40; ++i) {
    const TreeLevels next = levelsFrom(6.0 + (i % 2 ? 0.3 : 0.0), true, levels);
    changes += next == levels ? 0 : 1;
    levels = next;
  }
  EXPECT_LE(changes, 1);
}

// So that nothing tears: the trunk is that of its own level, and each bough is that of a tree of
// its level.
TEST(TreeLevels, AMeshIsPutTogetherFromThoseOfItsLevels) {
  const Boughs boughs(tree());
  TreeLevels levels;
  levels.trunk = GEOMETRY_LEVELS - 1;
  for (std::size_t i = 0; i < boughs.size(); ++i)
    levels.boughs.push_back(GEOMETRY_LEVELS - 1 - static_cast<int>(i) % 3);
  const auto parts = partsOf(buildMesh(tree(), oak(), treeMeshDetail(boughs, levels)), boughs);
  for (const auto& [bough, part] : parts) {
    const int level = bough < 0 ? levels.trunk : levels.boughs[static_cast<std::size_t>(bough)];
    const auto whole = partsOf(buildMesh(tree(), oak(), meshDetail(level)), boughs);
    EXPECT_EQ(part, whole.at(bough)) << bough << " at level " << level;
  }
  EXPECT_EQ(parts.size(), boughs.size() + 1);
}

// bough_bench measures pictures and other distances.
TEST(TreeLevels, BoughsSaveTrianglesOfNearTrees) {
  for (const double distance : {7.0, 8.0, 9.0}) {
    const std::size_t whole = trianglesOf(levelsFrom(distance, false)),
                      by_bough = trianglesOf(levelsFrom(distance, true));
    std::printf("%.0f m: %zu triangles, by bough %zu\n", distance, whole, by_bough);
    EXPECT_LT(1.3 * static_cast<double>(by_bough), static_cast<double>(whole));
  }
}

}  // namespace
}  // namespace vegetation_sim::forest
