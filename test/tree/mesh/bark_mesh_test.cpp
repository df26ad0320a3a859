// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/bark_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

Skeleton growShipped(const std::string& name, std::uint64_t seed) {
  TreeSeed tree;
  tree.seed = seed;
  return grow(tree, shippedSpecies(name));
}

TreeMesh meshOf(const std::string& name, std::uint64_t seed, const MeshDetail& detail) {
  return buildMesh(growShipped(name, seed), shippedSpecies(name), detail);
}

bool startsLimb(const Skeleton& skeleton, std::size_t i) {
  const int parent = skeleton.branches[i].parent;
  return parent < 0 ||
         skeleton.branches[static_cast<std::size_t>(parent)].next != static_cast<int>(i);
}

int segmentsOf(const Skeleton& skeleton, std::size_t first) {
  int out = 0;
  for (int i = static_cast<int>(first); i >= 0;
       i = skeleton.branches[static_cast<std::size_t>(i)].next)
    ++out;
  return out;
}

int sidesOf(const Branch& branch, const MeshDetail& detail) {
  return std::max(3, detail.trunk_sides - 4 * branch.depth);
}

class MeshOfSpecies : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, MeshOfSpecies, testing::ValuesIn(speciesNames()));

// S1-03: a near tree has about 10 000 polygons, a far one a few hundred at most.
TEST_P(MeshOfSpecies, HasTenThousandPolygonsNearAndFewFarAway) {
  double near_mean = 0.0;
  constexpr int TREES = 12;
  for (std::uint64_t seed = 0; seed < TREES; ++seed) {
    near_mean += static_cast<double>(
                     meshOf(GetParam(), seed, meshDetail(GEOMETRY_LEVELS - 1)).triangleCount()) /
                 TREES;
    EXPECT_LT(meshOf(GetParam(), seed, meshDetail(0)).triangleCount(), 200u);
    EXPECT_GT(meshOf(GetParam(), seed, meshDetail(0)).triangleCount(), 20u);
  }
  EXPECT_NEAR(near_mean, 10000.0, 3000.0);
}

// S1-08: two triangles per side and section of each limb, two per leaf cluster; the trunk has three
// sections more for its flare.
TEST_P(MeshOfSpecies, TriangleCountFollowsFromTheDetail) {
  const Skeleton skeleton = growShipped(GetParam(), 5);
  for (const int depths : {1, 2, 4}) {
    for (const int sides : {5, 8, 14}) {
      for (const int sections : {1, 2, 16}) {
        MeshDetail detail{depths, sides, sections, 0.0};
        std::size_t expected = 0;
        for (std::size_t i = 0; i < skeleton.branches.size(); ++i) {
          const Branch& branch = skeleton.branches[i];
          if (branch.depth >= depths || !startsLimb(skeleton, i)) continue;
          const int drawn = std::min(sections, segmentsOf(skeleton, i));
          const int flare = branch.parent < 0 ? 3 : 0;
          expected += static_cast<std::size_t>(2 * sidesOf(branch, detail) * (drawn + flare));
        }
        const TreeMesh mesh = buildMesh(skeleton, shippedSpecies(GetParam()), detail);
        EXPECT_TRUE(mesh.leaves.empty());
        EXPECT_EQ(mesh.triangleCount(), expected) << depths << " " << sides << " " << sections;
      }
    }
  }
}

// S1-08: sections share their rings, so that a tube has no hole but its two ends, however it bends:
// an edge is used only once on the ring at a limb's base or tip.
TEST_P(MeshOfSpecies, TubesAreClosedAtTheirJoints) {
  const MeshDetail detail = meshDetail(GEOMETRY_LEVELS - 1);
  const Skeleton skeleton = growShipped(GetParam(), 6);
  const TreeMesh mesh = buildMesh(skeleton, shippedSpecies(GetParam()), detail);
  // Vertices at the same place of a branch move as one: the seam of the texture.
  using Place = std::tuple<int, float, float, float>;
  std::map<Place, int> places;
  std::vector<int> welded;
  for (const BarkVertex& v : mesh.bark)
    welded.push_back(
        places.emplace(Place(v.branch, v.local[0], v.local[1], v.local[2]), places.size())
            .first->second);
  std::map<std::pair<int, int>, int> uses;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = welded[mesh.triangles[t + k]], b = welded[mesh.triangles[t + (k + 1) % 3]];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  int open = 0;
  for (const auto& use : uses) {
    EXPECT_LE(use.second, 2);
    open += use.second == 1 ? 1 : 0;
  }
  int ends = 0;
  for (std::size_t i = 0; i < skeleton.branches.size(); ++i)
    if (startsLimb(skeleton, i)) ends += 2 * sidesOf(skeleton.branches[i], detail);
  EXPECT_EQ(open, ends);
}

// S1-08: successive sections meet with one radius.
TEST_P(MeshOfSpecies, RadiusIsContinuousAlongALimb) {
  const Skeleton skeleton = growShipped(GetParam(), 7);
  for (const Branch& branch : skeleton.branches) {
    if (branch.next < 0) continue;
    EXPECT_NEAR(branch.tip_radius,
                skeleton.branches[static_cast<std::size_t>(branch.next)].base_radius, 1e-12);
  }
}

// S1-09: coarser levels draw fewer branches and fewer triangles.
TEST_P(MeshOfSpecies, TopologyIsSimplifiedLevelByLevel) {
  std::size_t branches_before = 0, triangles_before = 0;
  for (int level = 0; level < GEOMETRY_LEVELS; ++level) {
    const TreeMesh mesh = meshOf(GetParam(), 8, meshDetail(level));
    std::set<int> branches;
    for (const BarkVertex& vertex : mesh.bark) branches.insert(vertex.branch);
    EXPECT_GE(branches.size(), branches_before) << level;
    EXPECT_GT(mesh.triangleCount(), triangles_before) << level;
    branches_before = branches.size();
    triangles_before = mesh.triangleCount();
  }
  EXPECT_LT(meshOf(GetParam(), 8, meshDetail(0)).bark.size(), 20u);
  EXPECT_EQ(branches_before, growShipped(GetParam(), 8).branches.size());
}

// S1-09: a cluster on a branch that is not drawn keeps its place on one that is drawn.
TEST_P(MeshOfSpecies, LeavesOfBranchesLeftOutStayInPlace) {
  const Skeleton skeleton = growShipped(GetParam(), 9);
  MeshDetail all{MAX_DEPTHS, 8, 8, 1.0}, few = all;
  few.depths = 2;
  const Species species = shippedSpecies(GetParam());
  const TreeMesh full = buildMesh(skeleton, species, all),
                 coarse = buildMesh(skeleton, species, few);
  ASSERT_EQ(full.leaves.size(), coarse.leaves.size());
  const auto atRest = [&](const LeafCard& leaf) {
    const Pose& rest = skeleton.branches[static_cast<std::size_t>(leaf.branch)].rest;
    const Quat q{leaf.rotation[0], leaf.rotation[1], leaf.rotation[2], leaf.rotation[3]};
    const Vec3 foot(leaf.local[0], leaf.local[1], leaf.local[2]);
    // Foot and tip of the card.
    return std::pair<Vec3, Vec3>(rest.position + rotate(rest.orientation, foot),
                                 rest.position + rotate(rest.orientation, foot + axisY(q)));
  };
  for (std::size_t i = 0; i < full.leaves.size(); ++i) {
    EXPECT_LT(skeleton.branches[static_cast<std::size_t>(coarse.leaves[i].branch)].depth, 2);
    const auto a = atRest(full.leaves[i]), b = atRest(coarse.leaves[i]);
    // Single precision at 15 m.
    EXPECT_NEAR(length(a.first - b.first), 0.0, 1e-5);
    EXPECT_NEAR(length(a.second - b.second), 0.0, 1e-5);
  }
}

TEST_P(MeshOfSpecies, FewerLeavesAreASubsetOfMore) {
  MeshDetail many{MAX_DEPTHS, 8, 8, 0.6}, few = many;
  few.leaf_fraction = 0.2;
  std::set<std::uint32_t> keys;
  for (const LeafCard& leaf : meshOf(GetParam(), 10, many).leaves) keys.insert(leaf.key);
  const TreeMesh coarse = meshOf(GetParam(), 10, few);
  EXPECT_FALSE(coarse.leaves.empty());
  EXPECT_LT(coarse.leaves.size(), keys.size());
  for (const LeafCard& leaf : coarse.leaves) EXPECT_EQ(keys.count(leaf.key), 1u);
}

TEST_P(MeshOfSpecies, IsTheSameEachTime) {
  const TreeMesh a = meshOf(GetParam(), 11, meshDetail(4)),
                 b = meshOf(GetParam(), 11, meshDetail(4));
  ASSERT_EQ(a.bark.size(), b.bark.size());
  for (std::size_t i = 0; i < a.bark.size(); ++i) EXPECT_EQ(a.bark[i].local, b.bark[i].local);
  ASSERT_EQ(a.leaves.size(), b.leaves.size());
  for (std::size_t i = 0; i < a.leaves.size(); ++i)
    EXPECT_EQ(a.leaves[i].rotation, b.leaves[i].rotation);
}

// S1-W5
TEST(LeafFlutter, HasZeroMeanAndStaysWithinItsLimit) {
  constexpr double LARGEST = 0.3, SPEED = 6.0;
  for (const std::uint32_t key : {1u, 0x12345678u, 0xffffffffu, 0xdeadbeefu}) {
    std::array<double, 2> sum{}, squares{};
    constexpr int SAMPLES = 200000;
    for (int i = 0; i < SAMPLES; ++i) {
      const auto turn = leafFlutter(key, 1.7e9 + 0.01 * i, SPEED, LARGEST);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(std::abs(turn[k]), LARGEST);
        sum[k] += turn[k] / SAMPLES;
        squares[k] += turn[k] * turn[k] / SAMPLES;
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      // Tones of at least 0.9 Hz over 2000 s: the mean is at most 1 / (2 pi 0.9 2000) of the limit.
      EXPECT_NEAR(sum[k], 0.0, 1e-4);
      EXPECT_GT(squares[k], 1e-4);
    }
  }
}

// S1-W5
TEST(LeafFlutter, GrowsWithTheWindAndRestsInACalm) {
  const auto swing = [](double speed) {
    double out = 0.0;
    for (int i = 0; i < 1000; ++i)
      out = std::max(out, std::abs(static_cast<double>(leafFlutter(77, 0.02 * i, speed, 0.3)[0])));
    return out;
  };
  EXPECT_EQ(swing(0.0), 0.0);
  EXPECT_LT(swing(1.0), swing(4.0));
  EXPECT_LT(swing(4.0), swing(16.0));
  EXPECT_LE(swing(1e6), 0.3);
}

}  // namespace
}  // namespace vegetation_sim::forest
